//! MSH010 and MSH013: the chunks of binary glTF, and what formats leave open.

use serde_json::{Value, json};
use urdd_validate::code::Code::*;

use super::{BASE, change_gltf, path};
use crate::meshes::{HULLS, PLAIN};
use crate::{Case, invalid, near_miss};
use testkit::fixture::Fixture;

/// Changes the bytes of a GLB, and states their number in its header.
fn change_bytes(f: &mut Fixture, module: &str, change: impl Fn(&mut Vec<u8>)) {
    let path = path(f, module, BASE, "glb");
    let mut bytes = f.file(&path).to_vec();
    change(&mut bytes);
    let total = (bytes.len() as u32).to_le_bytes();
    bytes[8..12].copy_from_slice(&total);
    f.put_file(&path, bytes);
}

/// Adds to a length that the GLB states.
fn lengthen(bytes: &mut [u8], at: usize, by: u32) {
    let old: [u8; 4] = bytes[at..at + 4].try_into().expect("four");
    bytes[at..at + 4].copy_from_slice(&(u32::from_le_bytes(old) + by).to_le_bytes());
}

/// The offset of the second chunk.
fn second(bytes: &[u8]) -> usize {
    let length: [u8; 4] = bytes[12..16].try_into().expect("four");
    20 + u32::from_le_bytes(length) as usize
}

pub fn cases() -> Vec<Case> {
    let mut cases = chunks();
    cases.extend(open());
    cases
}

fn chunks() -> Vec<Case> {
    vec![
        invalid(MSH010, "chunk-beyond-the-end", |f| {
            change_bytes(f, HULLS, |bytes| {
                let at = second(bytes);
                lengthen(bytes, at, 4);
            });
        }),
        invalid(MSH010, "length-not-a-multiple-of-four", |f| {
            change_bytes(f, HULLS, |bytes| {
                bytes.insert(second(bytes), b' ');
                lengthen(bytes, 12, 1);
            });
        }),
        invalid(MSH010, "first-chunk-not-json", |f| {
            change_bytes(f, HULLS, |bytes| bytes[16..20].copy_from_slice(b"XTRA"));
        }),
        invalid(MSH010, "bytes-after-the-last-chunk", |f| {
            change_bytes(f, HULLS, |bytes| bytes.extend([0; 4]));
        }),
        invalid(MSH010, "chunk-one-byte-beyond-the-end", |f| {
            change_bytes(f, HULLS, |bytes| {
                let at = second(bytes);
                lengthen(bytes, at, 1);
            });
        }),
        invalid(MSH010, "version-1", |f| {
            change_bytes(f, HULLS, |bytes| bytes[4] = 1);
        }),
        near_miss(MSH010, "empty-chunk-at-the-end", |f| {
            change_bytes(f, HULLS, |bytes| bytes.extend(*b"\0\0\0\0XTRA"));
        }),
    ]
}

/// What SPEC 7.6 leaves open.
fn open() -> Vec<Case> {
    vec![
        near_miss(MSH013, "requires-an-avif-texture", |f| {
            change_gltf(f, PLAIN, |gltf| {
                for key in ["extensionsUsed", "extensionsRequired"] {
                    gltf[key] = json!(["EXT_texture_avif", "EXT_lights_ies"]);
                }
            });
        }),
        near_miss(MSH013, "requires-a-texture-of-a-vendor", |f| {
            change_gltf(f, PLAIN, |gltf| {
                for key in ["extensionsUsed", "extensionsRequired"] {
                    gltf[key] = json!(["MSFT_texture_dds", "ADOBE_materials_thin_transparency"]);
                }
            });
        }),
        invalid(MSH013, "requires-what-nobody-knows", |f| {
            change_gltf(f, PLAIN, |gltf| {
                for key in ["extensionsUsed", "extensionsRequired"] {
                    gltf[key] = json!(["EXT_textures"]);
                }
            });
        }),
        near_miss(MSH013, "no-weights-of-morph-targets", |f| {
            change_gltf(f, PLAIN, |gltf| gltf["meshes"][0]["weights"] = json!([]));
        }),
        invalid(MSH013, "no-triangle", |f| {
            let path = path(f, HULLS, BASE, "stl");
            f.put_file(&path, vec![0; 84]);
        }),
        near_miss(MSH013, "skin-that-no-scene-reaches", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["skins"] = json!([{ "joints": [1] }]);
                let nodes = gltf["nodes"].as_array_mut();
                let nodes: &mut Vec<Value> = nodes.expect("a list");
                nodes.push(json!({ "mesh": 0, "skin": 0, "translation": [1, 0, 0] }));
            });
        }),
    ]
}
