//! MSH013 to MSH023: the content of mesh files.

mod bodies;
mod glb;
pub mod originals;
pub mod placed_scenes;
mod polygons;
mod prism;
mod scenes;

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_geometry::read::Part;
use urdd_geometry::write;
use urdd_validate::code::Code::*;

use crate::meshes::{HULLS, ORIGINAL, PIECES, PLAIN, boxy, robot_of, text};
use crate::{Case, changed, invalid, near_miss};
use testkit::fixture::{Fixture, ROOT};
use testkit::robot::*;

/// The base: a box of 0.4 by 0.4 by 0.1 m around its link's origin, which is also its only piece.
pub const BASE: usize = 1;

/// The path of the entry of a link, or of its first piece.
pub fn entry(module: &str, link: usize) -> String {
    match module {
        PLAIN => format!("/link_meshes/{link}/files"),
        HULLS => format!("/link_hulls/{link}"),
        _ => format!("/link_pieces/{link}/0"),
    }
}

pub fn path(f: &Fixture, module: &str, link: usize, format: &str) -> String {
    text(f, module, &format!("{}/{format}", entry(module, link)))
}

/// A mesh, as read from its OBJ file.
pub fn read(f: &Fixture, module: &str, link: usize) -> Mesh {
    let obj = String::from_utf8(f.file(&path(f, module, link, "obj")).to_vec()).expect("text");
    let mut mesh = Mesh::default();
    for line in obj.lines() {
        let mut words = line.split(' ');
        let kind = words.next();
        match kind {
            Some("v") => {
                let numbers: Vec<f64> = words.map(|w| w.parse().expect("a number")).collect();
                mesh.vertices.push(numbers.try_into().expect("three numbers"));
            }
            Some("f") => {
                let corners: Vec<u32> = words.map(|w| w.parse().expect("an index")).collect();
                let [a, b, c]: [u32; 3] = corners.try_into().expect("three corners");
                mesh.triangles.push([a - 1, b - 1, c - 1]);
            }
            _ => {}
        }
    }
    mesh
}

pub fn put(f: &mut Fixture, module: &str, link: usize, format: &str, mesh: &Mesh) {
    let parts = [Part::from(mesh.clone())];
    let bytes = match format {
        "stl" => write::stl(&parts),
        "obj" => write::obj(&parts),
        _ => write::glb(&parts),
    };
    let path = path(f, module, link, format);
    f.put_file(&path, bytes.expect("a mesh that can be written"));
}

/// Changes a mesh in some of its formats.
pub fn rewrite(f: &mut Fixture, module: &str, formats: &[&str], change: impl Fn(&mut Mesh)) {
    let mut mesh = read(f, module, BASE);
    change(&mut mesh);
    for format in formats {
        put(f, module, BASE, format, &mesh);
    }
}

pub const ALL: &[&str] = &["stl", "obj", "glb"];

/// The next binary32.
fn up(x: f64) -> f64 {
    f64::from((x as f32).next_up())
}

/// Two boxes; the second names a file without a surface.
pub fn bare() -> Fixture {
    let mut bare = link("b");
    bare.visual.push(visual(None, mesh("package://robot/bare.stl", None)));
    let mut fixture = Fixture::full(&robot_of(vec![boxy("a"), bare]));
    let path = format!("mesh_modules/{ORIGINAL}/meshes/bare.stl");
    fixture.put_file(&path, vec![0; 84]);
    fixture.set(ORIGINAL, "/references/0/path", json!(path));
    let file = json!({"path": path, "side_files": [], "usable": false});
    fixture.set(ORIGINAL, "/files/-", file);
    let entry = json!({"path": path, "size": 0, "sha256": ""});
    let listed = fixture.doc_mut(ROOT).pointer_mut("/modules/6/files");
    let listed = listed.and_then(Value::as_array_mut).expect("a list");
    listed.insert(1, entry);
    fixture
}

/// Changes the JSON of a GLB.
pub fn change_gltf(f: &mut Fixture, module: &str, change: impl Fn(&mut Value)) {
    let path = path(f, module, BASE, "glb");
    let bytes = f.file(&path).to_vec();
    let length = |at: usize| {
        let four: [u8; 4] = bytes[at..at + 4].try_into().expect("four");
        u32::from_le_bytes(four) as usize
    };
    let end = 20 + length(12);
    let mut gltf: Value = serde_json::from_slice(&bytes[20..end]).expect("JSON");
    change(&mut gltf);
    let mut json = gltf.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut new = bytes[..12].to_vec();
    new.extend((json.len() as u32).to_le_bytes());
    new.extend(b"JSON");
    new.extend(json);
    new.extend(&bytes[end..]);
    let total = (new.len() as u32).to_le_bytes();
    new[8..12].copy_from_slice(&total);
    f.put_file(&path, new);
}

/// A box that is its own only piece, and a link without a shape.
pub fn lone_box() -> Fixture {
    Fixture::full(&robot_of(vec![link("a"), boxy("b")]))
}

/// Makes the piece of the lone box larger, and its box and sphere with it.
pub fn grow_piece(f: &mut Fixture, factor: f64) {
    const APPROXIMATIONS: &str = "link_shapes_approximations_module";
    const REACH: &str = "link_shapes_max_distance_from_origin_module";
    let mut mesh = read(f, PIECES, BASE);
    for vertex in &mut mesh.vertices {
        *vertex = vertex.map(|x| f64::from((x * factor) as f32));
    }
    for format in ALL {
        put(f, PIECES, BASE, format, &mesh);
    }
    let half = mesh.vertices[0].map(f64::abs);
    let reach = half.iter().map(|h| h * h).sum::<f64>().sqrt();
    f.set(APPROXIMATIONS, "/decomposition_obbs/1/0/half_extents", json!(half));
    f.set(APPROXIMATIONS, "/decomposition_bounding_spheres/1/0/radius", json!(reach));
    for list in ["convex_hulls", "obbs", "bounding_spheres"] {
        let pointer = format!("/decomposition_{list}_maximum_distances/1/0");
        f.set(REACH, &pointer, json!(reach));
    }
}

pub fn cases() -> Vec<Case> {
    let mut cases = files();
    cases.extend(glb::cases());
    cases.extend(originals::cases());
    cases.extend(prism::cases());
    cases.extend(placed_scenes::cases());
    cases.extend(polygons::cases());
    cases.extend(scenes::cases());
    cases.extend(bodies::cases());
    cases
}

/// Adds a triangle of this height to the OBJ of the base's plain mesh, beside an edge.
fn one_more(f: &mut Fixture, height: f64) {
    let mut mesh = read(f, PLAIN, BASE);
    let [a, b, c] = mesh.triangles[0];
    let [from, to, other] = mesh.corners([a, b, c]);
    let between = [0, 1, 2].map(|i| {
        let middle = (from[i] + to[i]) / 2.0;
        middle + height * (other[i] - middle)
    });
    let last = u32::try_from(mesh.vertices.len()).expect("few");
    mesh.vertices.push(between.map(|x| f64::from(x as f32)));
    mesh.triangles.push([a, b, last]);
    put(f, PLAIN, BASE, "obj", &mesh);
}

/// MSH013 and MSH014.
fn files() -> Vec<Case> {
    vec![
        invalid(MSH013, "coordinate-not-finite", |f| {
            let path = path(f, PIECES, BASE, "stl");
            let mut bytes = f.file(&path).to_vec();
            bytes[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
            f.put_file(&path, bytes);
        }),
        invalid(MSH013, "stl-as-text", |f| {
            let mesh = read(f, PLAIN, BASE);
            let mut text = "solid base\n".to_owned();
            for triangle in &mesh.triangles {
                text.push_str("facet normal 0 0 0\nouter loop\n");
                for [x, y, z] in mesh.corners(*triangle) {
                    text.push_str(&format!("vertex {x} {y} {z}\n"));
                }
                text.push_str("endloop\nendfacet\n");
            }
            text.push_str("endsolid base\n");
            let path = path(f, PLAIN, BASE, "stl");
            f.put_file(&path, text);
        }),
        invalid(MSH013, "normal-of-another-triangle", |f| {
            let path = path(f, HULLS, BASE, "stl");
            let mut bytes = f.file(&path).to_vec();
            bytes[84 + 3] ^= 0x80;
            f.put_file(&path, bytes);
        }),
        // Of a body so small that a height of a metre would be thin if lengths counted the other way round.
        changed(
            MSH013,
            "normal-of-another-triangle-of-a-small-box",
            true,
            || {
                let mut small = link("b");
                small.visual.push(visual(None, cuboid([0.01, 0.01, 0.02])));
                Fixture::full(&robot_of(vec![link("a"), small]))
            },
            |f| {
                let path = path(f, HULLS, BASE, "stl");
                let mut bytes = f.file(&path).to_vec();
                bytes[84 + 3] ^= 0x80;
                f.put_file(&path, bytes);
            },
        ),
        invalid(MSH013, "obj-holds-stl", |f| {
            let stl = f.file(&path(f, HULLS, BASE, "stl")).to_vec();
            let path = path(f, HULLS, BASE, "obj");
            f.put_file(&path, stl);
        }),
        invalid(MSH013, "vertex-that-no-face-uses-in-the-glb", |f| {
            let mut mesh = read(f, PIECES, BASE);
            mesh.vertices.push([1000.0, 0.0, 0.0]);
            put(f, PIECES, BASE, "glb", &mesh);
        }),
        invalid(MSH013, "image-outside", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["images"] = json!([{ "uri": "../../../../secret.png" }]);
            });
        }),
        invalid(MSH013, "morph-target", |f| {
            change_gltf(f, PLAIN, |gltf| {
                let primitive = &mut gltf["meshes"][0]["primitives"][0];
                primitive["targets"] = json!([{ "POSITION": 0 }]);
            });
        }),
        invalid(MSH013, "skin", |f| {
            change_gltf(f, PLAIN, |gltf| gltf["nodes"][0]["skin"] = json!(0));
        }),
        invalid(MSH013, "instances", |f| {
            change_gltf(f, HULLS, |gltf| {
                gltf["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": {} });
            });
        }),
        invalid(MSH013, "animation", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["animations"] = json!([{ "channels": [], "samplers": [] }]);
            });
        }),
        invalid(MSH013, "least-coordinate-of-other-positions", |f| {
            change_gltf(f, HULLS, |gltf| gltf["accessors"][0]["min"][0] = json!(-1));
        }),
        invalid(MSH013, "node-with-a-transform", |f| {
            change_gltf(f, HULLS, |gltf| {
                // Within the resolution, nothing has moved.
                gltf["nodes"][0]["translation"] = json!([1e-9, 0, 0]);
            });
        }),
        invalid(MSH013, "normals-of-no-length", |f| {
            // The positions in place of the normals.
            change_gltf(f, PLAIN, |gltf| {
                gltf["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(0);
            });
        }),
        near_miss(MSH013, "embedded-image-and-nodes-in-their-place", |f| {
            change_gltf(f, PLAIN, |gltf| {
                gltf["images"] = json!([{ "uri": "data:image/png;base64,iVBORw0KGgo=" }]);
                gltf["nodes"] = json!([
                    { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
                    { "children": [0], "translation": [0, 0, 0], "scale": [1, 1, 1] },
                ]);
                gltf["scenes"][0]["nodes"] = json!([1]);
            });
        }),
        near_miss(MSH013, "what-formats-leave-open", |f| {
            let stl = path(f, HULLS, BASE, "stl");
            let mut bytes = f.file(&stl).to_vec();
            bytes[..20].copy_from_slice(b"solid, but binary   ");
            f.put_file(&stl, bytes);
            let obj = path(f, HULLS, BASE, "obj");
            let text = String::from_utf8(f.file(&obj).to_vec()).expect("text");
            f.put_file(&obj, format!("# a hull\no base\n{text}\n"));
        }),
        invalid(MSH014, "glb-turned-to-y-up", |f| {
            rewrite(f, HULLS, &["glb"], |mesh| {
                for [_, y, z] in &mut mesh.vertices {
                    (*y, *z) = (*z, -*y);
                }
            });
        }),
        invalid(MSH014, "triangle-turned-round-in-the-stl", |f| {
            rewrite(f, PIECES, &["stl"], |mesh| mesh.triangles[4].swap(0, 1));
        }),
        near_miss(MSH014, "triangle-without-height-in-one-format", |f| one_more(f, 0.0)),
        invalid(MSH014, "small-triangle-in-one-format", |f| one_more(f, 1e-4)),
        near_miss(MSH014, "rounded-otherwise", |f| {
            rewrite(f, PLAIN, &["glb"], |mesh| {
                mesh.vertices[5] = mesh.vertices[5].map(up);
            });
        }),
    ]
}
