//! Files that are odd or broken.

use serde_json::{Value, json};
use urdd_geometry::read::{Fault, GltfUp, NoteCode};

use super::{codes, document, glb, load, load_bytes};

#[test]
fn what_is_broken_is_an_error_or_a_note() {
    let change = |pointer: &str, value: Value| {
        let (mut root, data) = document();
        *root.pointer_mut(pointer).unwrap() = value;
        load(&root, &data)
    };
    for (pointer, value) in [
        ("/accessors/0/count", json!(5)),
        ("/accessors/0/count", json!(u64::MAX)),
        ("/bufferViews/1/byteLength", json!(49)),
        ("/bufferViews/1/byteOffset", json!(u64::MAX)),
    ] {
        assert!(
            matches!(change(pointer, value.clone()).unwrap_err().fault, Fault::Truncated(_)),
            "{pointer} {value}"
        );
    }
    for (pointer, value) in [
        ("/accessors/0/count", json!(-1)),
        ("/accessors/0/type", json!("VEC2")),
        ("/accessors/0/componentType", json!(5125)),
        ("/accessors/1/componentType", json!(5126)),
        ("/accessors/0/bufferView", json!(7)),
        ("/meshes/0/primitives/0/indices", json!(2)),
        ("/bufferViews/0/buffer", json!(1)),
        ("/nodes/0/mesh", json!(1)),
        ("/nodes/0", json!({"children": [0]})),
        (
            "/nodes/0",
            json!({"mesh": 0, "scale": [1e308, 1, 1], "rotation": [1e300, 1e300, 0, 0], "children": [9]}),
        ),
        ("/scene", json!(3)),
        ("/asset", json!(3)),
    ] {
        assert!(
            matches!(change(pointer, value.clone()).unwrap_err().fault, Fault::Malformed(_)),
            "{pointer} {value}"
        );
    }
    assert!(matches!(
        change("/asset/version", json!("1.0")).unwrap_err().fault,
        Fault::NotSupported(_)
    ));
    let (mut root, data) = document();
    root["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    assert!(matches!(load(&root, &data).unwrap_err().fault, Fault::NotSupported(_)));
    root["extensionsRequired"] = json!(["VENDOR_shape"]);
    assert_eq!(codes(&load(&root, &data).unwrap()), [NoteCode::LeftOut]);
    root["extensionsRequired"] =
        json!(["EXT_texture_avif", "EXT_lights_ies", "KHR_materials_ior", "KHR_mesh_quantization"]);
    assert_eq!(codes(&load(&root, &data).unwrap()), []);
    let (mut root, data) = document();
    root["accessors"][0] =
        json!({"componentType": 5126, "count": 4_000_000_000_u64, "type": "VEC3"});
    assert!(matches!(load(&root, &data).unwrap_err().fault, Fault::TooLarge { .. }));
    let (root, mut data) = document();
    data[48..52].copy_from_slice(&[9, 0, 0, 0]);
    let scene = load(&root, &data).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (3, vec![NoteCode::IndexOutOfRange]));
}

#[test]
fn nodes_that_multiply_without_end() {
    let (mut root, data) = document();
    let mut nodes: Vec<Value> =
        (0..40).map(|level| json!({"children": [level + 1, level + 1]})).collect();
    nodes.push(json!({"mesh": 0}));
    root["nodes"] = json!(nodes);
    assert!(matches!(load(&root, &data).unwrap_err().fault, Fault::TooLarge { .. }));
}

#[test]
fn glb_containers_that_are_odd() {
    let (root, data) = document();
    let whole = glb(&root, &data);
    let mut wrong = whole.clone();
    wrong[8..12].copy_from_slice(&7_u32.to_le_bytes());
    let scene = load_bytes(&wrong, "a.glb", GltfUp::Keep, &[]).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (4, vec![NoteCode::WrongCount]));
    let error = load_bytes(&whole[..whole.len() - 4], "a.glb", GltfUp::Keep, &[]).unwrap_err();
    assert!(matches!(error.fault, Fault::Truncated(_)), "{error}");
    let mut old = whole.clone();
    old[4] = 1;
    assert!(matches!(
        load_bytes(&old, "a.glb", GltfUp::Keep, &[]).unwrap_err().fault,
        Fault::NotSupported(_)
    ));
    for length in 4..20 {
        assert!(load_bytes(&whole[..length], "a.glb", GltfUp::Keep, &[]).is_err());
    }
}
