//! The readers of meshes, compared with output written from what they read.

use urdd_geometry::read::{Format, GltfUp, Options, Part, Scene, read_with};
use urdd_geometry::write;

pub fn stl(bytes: &[u8]) {
    check(bytes, "mesh.stl");
}

pub fn obj(bytes: &[u8]) {
    check(bytes, "mesh.obj");
}

pub fn gltf(bytes: &[u8]) {
    check(bytes, "mesh.gltf");
}

pub fn glb(bytes: &[u8]) {
    check(bytes, "mesh.glb");
}

pub fn dae(bytes: &[u8]) {
    check(bytes, "mesh.dae");
}

/// Fewer than by default: an input may ask for far more than it contains.
const OPTIONS: Options =
    Options { gltf_up: GltfUp::Keep, max_triangles: 100_000, uncut: false, textures: false };

/// A mesh that was read has finite vertices, indices in range and colours from 0 to 1. Reading it again gives the same.
/// Written in any format and read again, it has the same triangles.
fn check(bytes: &[u8], name: &str) {
    // Every side file has the content of the mesh: a .mtl in the .obj, a buffer in the .gltf.
    let mut fetch = |_: &str| Some(bytes.to_owned());
    let scene = match read_with(bytes, name, &mut fetch, &OPTIONS) {
        Ok(scene) => scene,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    assert_eq!(read_with(bytes, name, &mut fetch, &OPTIONS).as_ref(), Ok(&scene), "read twice");
    for note in &scene.notes {
        assert!(!note.to_string().is_empty() && note.count > 0);
    }
    assert!(scene.side_files.is_sorted());
    assert!(scene.triangle_count() <= OPTIONS.max_triangles);
    for part in &scene.parts {
        assert!(!part.mesh.triangles.is_empty());
        let finite = part.mesh.vertices.iter().flatten().all(|x| x.is_finite());
        assert!(finite, "a vertex that is not finite");
        let count = part.mesh.vertices.len();
        let mut corners = part.mesh.triangles.iter().flatten();
        assert!(corners.all(|corner| (*corner as usize) < count));
        let mut color = part.color.iter().flatten();
        assert!(color.all(|x| (0.0..=1.0).contains(x)), "{:?}", part.color);
    }
    come_back(scene);
}

fn come_back(scene: Scene) {
    let mut parts = scene.parts;
    for part in &mut parts {
        part.mesh.round_to_f32();
    }
    parts.retain(|part| !part.mesh.triangles.is_empty());
    if parts.is_empty() {
        return;
    }
    let written = [
        (Format::StlBinary, write::stl(&parts)),
        (Format::Obj, write::obj(&parts)),
        (Format::Glb, write::glb(&parts)),
    ];
    for (format, bytes) in written {
        let bytes = bytes.expect("what was read can be written");
        let name = format!("mesh.{}", format.extension());
        let again = read_with(&bytes, &name, &mut |_| None, &OPTIONS);
        let mut again = again.expect("what was written can be read");
        assert_eq!(again.format, format);
        assert!(again.side_files.is_empty());
        for part in &mut again.parts {
            part.mesh.round_to_f32();
        }
        let (mut found, mut wanted) = (triangles(&again.parts), triangles(&parts));
        if format == Format::Glb {
            // Parts without a colour have no material there, and come back as one part.
            found.sort_unstable();
            wanted.sort_unstable();
        }
        assert!(found == wanted, "{name} differs");
    }
}

/// The corners of every triangle, in order.
fn triangles(parts: &[Part]) -> Vec<[[u64; 3]; 3]> {
    let of = |part: &Part| {
        let mesh = part.mesh.clone();
        let triangles = mesh.triangles.clone();
        triangles
            .into_iter()
            .map(move |triangle| mesh.corners(triangle).map(|corner| corner.map(f64::to_bits)))
    };
    parts.iter().flat_map(of).collect()
}
