//! Written meshes: read back by our readers, and inspected byte by byte. Other programs read them in
//! `scripts/compare_meshes.py`.

use serde_json::{Value, json};
use urdd_geometry::Mesh;
use urdd_geometry::primitives;
use urdd_geometry::read::{Format, GltfUp, Options, Part, Scene, read_with};
use urdd_geometry::write::{WriteError, glb, obj, stl};

fn load(bytes: &[u8]) -> Scene {
    read_with(bytes, "x", &mut |_| None, &Options { gltf_up: GltfUp::Keep, ..Options::default() })
        .unwrap()
}

/// Two parts with a colour each, one without, in binary32.
fn parts() -> Vec<Part> {
    let colors = [Some([0.25, 0.5, 0.75, 1.0]), None, Some([1.0, 0.0, 0.0, 0.5])];
    let meshes = [
        primitives::capsule(0.1, 0.3),
        primitives::cuboid([0.1, 0.2, 0.3]),
        primitives::sphere(1e-7),
    ];
    let mut parts: Vec<Part> = meshes.into_iter().map(Part::from).collect();
    // An odd number of triangles has indices that end between multiples of 4 bytes.
    parts[0].mesh.triangles.pop();
    for (part, color) in parts.iter_mut().zip(colors) {
        part.mesh.round_to_f32();
        part.color = color;
        part.material = color.map(|_| "paint \"1\"".to_owned());
    }
    parts
}

/// The corners of each triangle as binary32, as in the text of the OBJ.
fn corners(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    let mut mesh = mesh.clone();
    mesh.round_to_f32();
    mesh.triangles.iter().map(|triangle| mesh.corners(*triangle)).collect()
}

fn json_of(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(
        (&glb[..4], word(4), word(8), &glb[16..20]),
        (&b"glTF"[..], 2, glb.len(), &b"JSON"[..])
    );
    let end = 20 + word(12);
    assert_eq!(
        (end % 4, &glb[end + 4..end + 8], end + 8 + word(end)),
        (0, &b"BIN\0"[..], glb.len())
    );
    (serde_json::from_slice(&glb[20..end]).unwrap(), &glb[end + 8..])
}

#[test]
fn all_formats_hold_the_same_triangles_in_the_same_order() {
    let parts = parts();
    let expected: Vec<_> = parts.iter().flat_map(|part| corners(&part.mesh)).collect();
    for (bytes, format) in
        [(stl(&parts), Format::StlBinary), (obj(&parts), Format::Obj), (glb(&parts), Format::Glb)]
    {
        let scene = load(&bytes.unwrap());
        assert_eq!((scene.format, &scene.notes[..]), (format, &[][..]));
        assert!(corners(&scene.merged()) == expected, "{format:?}");
    }
}

#[test]
fn vertices_and_indices_come_back_as_they_were() {
    let parts = parts();
    for bytes in [obj(&parts).unwrap(), glb(&parts).unwrap()] {
        let scene = load(&bytes);
        let (mut found, mut expected) =
            (scene.merged(), Scene { parts: parts.clone(), ..scene }.merged());
        assert!(corners(&found) == corners(&expected));
        // Readers number vertices by first use, so only their number can be compared.
        found.weld();
        expected.weld();
        assert_eq!(found.vertices.len(), expected.vertices.len());
    }
    let colors: Vec<_> = load(&glb(&parts).unwrap())
        .parts
        .iter()
        .map(|part| (part.color, part.material.clone()))
        .collect();
    assert_eq!(
        colors,
        parts.iter().map(|part| (part.color, part.material.clone())).collect::<Vec<_>>()
    );
}

#[test]
fn the_text_of_obj_is_the_shortest() {
    let mesh = Mesh {
        vertices: vec![
            [0.1, -0.0, 1.0],
            [1e-10, 16_777_216.0, -2.5],
            [f64::from(f32::MAX), 0.0, f64::from(1.0_f32 / 3.0)],
        ],
        triangles: vec![[0, 1, 2]],
    };
    let text = String::from_utf8(obj(&[mesh.into()]).unwrap()).unwrap();
    assert_eq!(text, "v 0.1 0 1\nv 1e-10 16777216 -2.5\nv 3.4028235e+38 0 0.33333334\nf 1 2 3\n");
}

#[test]
fn the_text_of_obj_survives_a_reader_in_binary64() {
    // The shortest text of this number, 7.038531e-26, is nearest to it among binary32 numbers. Rounded to binary64
    // first, it is half way between two, and becomes the wrong one.
    let value = f64::from(f32::from_bits(0x15ae_43fd));
    let mesh = Mesh {
        vertices: vec![[value, 0.0, 0.0], [-value, 1.0, 0.0], [0.0, 0.0, 1.0]],
        triangles: vec![[0, 1, 2]],
    };
    let mut found = load(&obj(&[mesh.clone().into()]).unwrap()).merged();
    found.round_to_f32();
    assert_eq!(found, mesh);
}

#[test]
fn stl_has_unit_normals_and_a_header_that_is_not_solid() {
    let mesh = Mesh {
        vertices: vec![[0.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]],
        triangles: vec![[0, 1, 2], [0, 0, 1]],
    };
    let bytes = stl(&[mesh.into()]).unwrap();
    assert_eq!((bytes.len(), bytes[80..84].to_vec()), (84 + 2 * 50, vec![2, 0, 0, 0]));
    assert!(!bytes.starts_with(b"solid"));
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!([float(84), float(88), float(92)], [1.0, 0.0, 0.0]);
    assert_eq!([float(134), float(138), float(142)], [0.0; 3]);
}

#[test]
fn glb_follows_the_rules_of_gltf() {
    let parts = parts();
    let bytes = glb(&parts).unwrap();
    let (root, data) = json_of(&bytes);
    assert_eq!(root["nodes"], json!([{"mesh": 0}]));
    assert_eq!(root["buffers"], json!([{"byteLength": data.len()}]));
    let primitives = root["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 3);
    assert_eq!(root["materials"].as_array().unwrap().len(), 2);
    let mut end = 0;
    for view in root["bufferViews"].as_array().unwrap() {
        // Views follow one another, each at a multiple of 4, with less than 4 bytes between them.
        let offset = usize::try_from(view["byteOffset"].as_u64().unwrap()).unwrap();
        assert!(offset % 4 == 0 && offset - end < 4);
        end = offset + usize::try_from(view["byteLength"].as_u64().unwrap()).unwrap();
    }
    assert!(data.len() - end < 4);
    for (primitive, part) in primitives.iter().zip(&parts) {
        let positions =
            &root["accessors"][primitive["attributes"]["POSITION"].as_u64().unwrap() as usize];
        let bounds = part.mesh.bounds().unwrap();
        assert_eq!(
            (&positions["min"], &positions["max"]),
            (&json!(bounds.min), &json!(bounds.max))
        );
        let indices = &root["accessors"][primitive["indices"].as_u64().unwrap() as usize];
        assert_eq!(
            (indices["componentType"].as_u64(), indices["count"].as_u64()),
            (Some(5123), Some(part.mesh.triangles.len() as u64 * 3))
        );
        assert_eq!(primitive.get("material").is_some(), part.color.is_some());
    }
}

#[test]
fn many_vertices_need_wide_indices() {
    for (count, component) in [(65535, 5123), (65536, 5125)] {
        let vertices = (0..count).map(|at| [f64::from(at), 0.0, 1.0]).collect();
        let mesh = Mesh { vertices, triangles: vec![[0, 1, u32::try_from(count - 1).unwrap()]] };
        let bytes = glb(&[mesh.into()]).unwrap();
        assert_eq!(json_of(&bytes).0["accessors"][1]["componentType"], component);
        assert_eq!(load(&bytes).merged().vertices[2], [f64::from(count - 1), 0.0, 1.0]);
    }
}

#[test]
fn what_cannot_be_written_is_refused() {
    let triangle = |vertices: Vec<[f64; 3]>, triangle: [u32; 3]| {
        vec![Part::from(Mesh { vertices, triangles: vec![triangle] })]
    };
    for write in [stl, obj, glb] {
        assert_eq!(write(&[]), Err(WriteError::Empty));
        assert_eq!(write(&[Part::default()]), Err(WriteError::Empty));
        assert_eq!(
            write(&triangle(vec![[0.0; 3], [1e39, 0.0, 0.0]], [0, 1, 1])),
            Err(WriteError::NotFinite { part: 0, vertex: 1 })
        );
        assert_eq!(
            write(&triangle(vec![[0.0; 3]], [0, 0, 1])),
            Err(WriteError::IndexOutOfRange { part: 0, triangle: 0 })
        );
    }
}
