//! glTF and GLB. All files are written here.

mod broken;

use base64::Engine as _;
use serde_json::{Value, json};
use urdd_geometry::read::{Fault, Format, GltfUp, MeshError, NoteCode, Options, Scene, read_with};

/// The tetrahedron of legs 1, 2, 3 at the origin.
const POSITIONS: [[f32; 3]; 4] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
const CORNERS: [u8; 12] = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];

fn floats(values: &[[f32; 3]]) -> Vec<u8> {
    values.iter().flatten().flat_map(|value| value.to_le_bytes()).collect()
}

/// A document with a mesh of POSITION 0 and indices 1 in one buffer: positions, 12 indices of 4 bytes.
fn document() -> (Value, Vec<u8>) {
    let mut data = floats(&POSITIONS);
    data.extend(CORNERS.iter().flat_map(|corner| u32::from(*corner).to_le_bytes()));
    let root = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 12, "type": "SCALAR"},
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 48}],
        "buffers": [{"byteLength": 96}],
    });
    (root, data)
}

fn glb(root: &Value, data: &[u8]) -> Vec<u8> {
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |length: usize| u32::try_from(length).unwrap().to_le_bytes();
    [
        b"glTF",
        &word(2)[..],
        &word(28 + json.len() + data.len()),
        &word(json.len()),
        b"JSON",
        &json,
        &word(data.len()),
        b"BIN\0",
        data,
    ]
    .concat()
}

fn load_bytes(
    bytes: &[u8],
    name: &str,
    gltf_up: GltfUp,
    files: &[(&str, &[u8])],
) -> Result<Scene, MeshError> {
    let mut fetch = |wanted: &str| {
        files.iter().find(|(file, _)| *file == wanted).map(|(_, bytes)| bytes.to_vec())
    };
    read_with(bytes, name, &mut fetch, &Options { gltf_up, ..Options::default() })
}

fn load(root: &Value, data: &[u8]) -> Result<Scene, MeshError> {
    load_bytes(&glb(root, data), "a.glb", GltfUp::Keep, &[])
}

fn high(scene: &Scene) -> [f64; 3] {
    scene.merged().bounds().unwrap().max
}

fn codes(scene: &Scene) -> Vec<NoteCode> {
    scene.notes.iter().map(|note| note.code).collect()
}

#[test]
fn a_glb_is_turned_to_z_up_unless_told_otherwise() {
    let (root, data) = document();
    let kept = load(&root, &data).unwrap();
    assert_eq!(
        (kept.format, high(&kept), kept.merged().signed_volume(), codes(&kept)),
        (Format::Glb, [1.0, 2.0, 3.0], 1.0, vec![])
    );
    let turned = load_bytes(&glb(&root, &data), "a.GLB", GltfUp::Turn, &[]).unwrap();
    // Its y is our z, its z our -y.
    assert_eq!(
        turned.merged().vertices,
        [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [0.0, -3.0, 0.0]]
    );
    assert_eq!(
        (turned.merged().signed_volume(), codes(&turned)),
        (1.0, vec![NoteCode::TurnedToZUp])
    );
}

#[test]
fn buffers_in_files_and_data_uris() {
    let (mut root, data) = document();
    root["buffers"][0]["uri"] = json!("my%20data.bin");
    root["images"] =
        json!([{"uri": "skin.png"}, {"uri": "data:image/png;base64,AAAA"}, {"bufferView": 0}]);
    let text = root.to_string();
    let scene =
        load_bytes(text.as_bytes(), "a.gltf", GltfUp::Keep, &[("my data.bin", &data)]).unwrap();
    assert_eq!(
        (scene.format, high(&scene), &scene.side_files[..]),
        (Format::Gltf, [1.0, 2.0, 3.0], &["my data.bin".to_owned(), "skin.png".to_owned()][..])
    );
    let error = load_bytes(text.as_bytes(), "a.gltf", GltfUp::Keep, &[]).unwrap_err();
    assert_eq!(error.fault, Fault::NoSideFile("my data.bin".to_owned()));
    let cut = load_bytes(text.as_bytes(), "a.gltf", GltfUp::Keep, &[("my data.bin", &data[..95])])
        .unwrap_err();
    assert!(matches!(cut.fault, Fault::Truncated(_)), "{cut}");
    use base64::engine::general_purpose::{STANDARD, STANDARD_NO_PAD};
    let longer = [&data[..], b"x"].concat();
    for encoded in [STANDARD.encode(&longer), STANDARD_NO_PAD.encode(&longer)] {
        root["buffers"][0]["uri"] =
            json!(format!("data:application/octet-stream;base64,{encoded}"));
        assert_eq!(
            high(&load_bytes(root.to_string().as_bytes(), "a.gltf", GltfUp::Keep, &[]).unwrap()),
            [1.0, 2.0, 3.0]
        );
    }
    let escaped: String = longer.iter().map(|byte| format!("%{byte:02X}")).collect();
    root["buffers"][0]["uri"] = json!(format!("data:application/octet-stream,{escaped}"));
    let load = |root: &Value| load_bytes(root.to_string().as_bytes(), "a.gltf", GltfUp::Keep, &[]);
    assert_eq!(high(&load(&root).unwrap()), [1.0, 2.0, 3.0]);
    root["buffers"][0]["byteLength"] = json!(longer.len() + 1);
    let short = load(&root).unwrap_err();
    assert!(matches!(short.fault, Fault::Truncated(_)), "{short}");
    root["buffers"][0]["byteLength"] = json!(longer.len());
    root["scene"] = json!(0);
    root.as_object_mut().unwrap().remove("scenes");
    assert!(matches!(load(&root).unwrap_err().fault, Fault::Malformed(_)));
}

#[test]
fn indices_of_every_kind_and_none() {
    for (component, size) in [(5121, 1), (5123, 2), (5125, 4)] {
        let (mut root, _) = document();
        let mut data = floats(&POSITIONS);
        data.extend(
            CORNERS.iter().flat_map(|corner| u32::from(*corner).to_le_bytes()[..size].to_vec()),
        );
        data.resize(96, 0);
        root["accessors"][1]["componentType"] = json!(component);
        root["bufferViews"][1]["byteLength"] = json!(12 * size);
        assert_eq!(load(&root, &data).unwrap().merged().signed_volume(), 1.0, "{component}");
    }
    let (mut root, _) = document();
    root["meshes"][0]["primitives"][0] = json!({"attributes": {"POSITION": 0}});
    root["accessors"][0]["count"] = json!(12);
    root["bufferViews"][0]["byteLength"] = json!(144);
    root["buffers"][0]["byteLength"] = json!(144);
    let soup: Vec<[f32; 3]> =
        CORNERS.iter().map(|corner| POSITIONS[usize::from(*corner)]).collect();
    let scene = load(&root, &floats(&soup)).unwrap();
    assert_eq!((scene.triangle_count(), scene.merged().signed_volume()), (4, 1.0));
}

#[test]
fn strips_fans_and_what_is_no_surface() {
    let square: [[f32; 3]; 4] =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    for (mode, corners, area) in [
        (4, [0, 1, 2, 3], 0.5),
        (5, [0, 1, 3, 2], 1.0),
        (6, [0, 1, 2, 3], 1.0),
        (1, [0, 1, 2, 3], 0.0),
    ] {
        let (mut root, _) = document();
        let mut data = floats(&square);
        data.extend(corners.iter().flat_map(|corner: &u32| corner.to_le_bytes()));
        data.resize(96, 0);
        root["accessors"][1]["count"] = json!(4);
        root["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        let mesh = load(&root, &data).unwrap().merged();
        assert_eq!(mesh.area(), area, "{mode}");
        for triangle in &mesh.triangles {
            let [a, b, c] = mesh.corners(*triangle);
            assert!(
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0,
                "mode {mode} faces up"
            );
        }
    }
}

#[test]
fn nodes_nest_with_matrix_or_parts() {
    let (mut root, data) = document();
    root["nodes"] = json!([
        {"children": [1], "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1]},
        // A quarter turn about z.
        {"children": [2], "rotation": [0.0, 0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt()], "translation": [1, 0, 0], "scale": [1, 1, 10]},
        {"mesh": 0},
    ]);
    let bounds = load(&root, &data).unwrap().merged().bounds().unwrap();
    for (found, expected) in
        bounds.min.into_iter().chain(bounds.max).zip([8.0, 20.0, 30.0, 12.0, 22.0, 90.0])
    {
        assert!((found - expected).abs() < 1e-12, "{bounds:?}");
    }
    root["nodes"] = json!([{"mesh": 0, "scale": [-1, 1, 1]}]);
    assert_eq!(load(&root, &data).unwrap().merged().signed_volume(), 1.0);
}

#[test]
fn the_default_scene_counts() {
    let (mut root, data) = document();
    root["nodes"] =
        json!([{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0], "children": [2]}, {"mesh": 0}]);
    root["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
    root["scene"] = json!(1);
    assert_eq!(load(&root, &data).unwrap().triangle_count(), 8);
    root.as_object_mut().unwrap().remove("scene");
    let scene = load(&root, &data).unwrap();
    assert_eq!((scene.triangle_count(), codes(&scene)), (4, vec![NoteCode::Assumed]));
    root.as_object_mut().unwrap().remove("scenes");
    let scene = load(&root, &data).unwrap();
    assert_eq!(
        (scene.triangle_count(), codes(&scene)),
        (12, vec![NoteCode::Assumed, NoteCode::NodeTransform])
    );
}

#[test]
fn sparse_positions_with_and_without_a_base() {
    for base in [true, false] {
        let (mut root, mut data) = document();
        data.extend([1, 0, 3, 0]);
        data.extend(floats(&[[7.0, 0.0, 0.0], [0.0, 0.0, 9.0]]));
        root["buffers"][0]["byteLength"] = json!(data.len());
        root["bufferViews"].as_array_mut().unwrap().extend([
            json!({"buffer": 0, "byteOffset": 96, "byteLength": 4}),
            json!({"buffer": 0, "byteOffset": 100, "byteLength": 24}),
        ]);
        root["accessors"][0]["sparse"] = json!({"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}});
        if !base {
            root["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        }
        assert_eq!(high(&load(&root, &data).unwrap()), [7.0, if base { 2.0 } else { 0.0 }, 9.0]);
    }
}

#[test]
fn interleaved_and_quantized_positions() {
    let (mut root, _) = document();
    // Three 16-bit numbers, normalized, every 8 bytes: 32767 is 1.
    let mut data: Vec<u8> = [[0, 0, 0], [32767, 0, 0], [0, 32767, 0], [0, 0, -32768]]
        .iter()
        .flat_map(|[x, y, z]: &[i16; 3]| [*x, *y, *z, 99].map(i16::to_le_bytes).concat())
        .collect();
    data.resize(48, 0);
    data.extend(CORNERS.iter().flat_map(|corner| u32::from(*corner).to_le_bytes()));
    root["bufferViews"][0]["byteStride"] = json!(8);
    root["accessors"][0]["componentType"] = json!(5122);
    root["accessors"][0]["normalized"] = json!(true);
    root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let scene = load(&root, &data).unwrap();
    assert_eq!(
        (high(&scene), scene.merged().bounds().unwrap().min[2], codes(&scene)),
        ([1.0, 1.0, 0.0], -1.0, vec![])
    );
}

#[test]
fn colours() {
    for (material, color) in [
        (
            json!({"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 1, 0.5]}}),
            Some([0.25, 0.5, 1.0, 0.5]),
        ),
        (json!({}), Some([1.0; 4])),
        (json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}), None),
        (
            json!({"extensions": {"KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0, 1, 0, 1]}}}),
            Some([0.0, 1.0, 0.0, 1.0]),
        ),
    ] {
        let (mut root, data) = document();
        root["materials"] = json!([material]);
        root["meshes"][0]["primitives"][0]["material"] = json!(0);
        assert_eq!(load(&root, &data).unwrap().parts[0].color, color, "{material}");
    }
    let (root, data) = document();
    assert_eq!(load(&root, &data).unwrap().parts[0].color, None);
}
