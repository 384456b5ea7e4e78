//! What a mesh file holds, as far as it is compared: its triangles, whatever their order and the file's format.

use nalgebra::Matrix4;
use sha2::{Digest, Sha256};

use urdd_geometry::Mesh;
use urdd_geometry::mesh::Bounds;
use urdd_geometry::read::Scene;

/// The triangles of a mesh file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Triangles {
    /// SHA-256 of the sorted triangles.
    pub fingerprint: String,
    /// Number of triangles.
    pub count: usize,
}

/// Corners rounded to binary32, as bits: STL and glTF hold no more.
type Corner = [u32; 3];

/// The triangles of a scene in the file's own frame. A triangle with two equal corners has no surface and is left out.
pub(super) fn triangles(scene: &Scene) -> Triangles {
    let mut all: Vec<[Corner; 3]> = Vec::with_capacity(scene.triangle_count());
    for mesh in scene.parts.iter().map(|part| &part.mesh) {
        let corners = |triangle: [u32; 3]| mesh.corners(triangle).map(rounded);
        let triangles = mesh.triangles.iter().map(|triangle| corners(*triangle));
        all.extend(triangles.filter(|[a, b, c]| a != b && b != c && c != a).map(turned));
    }
    all.sort_unstable();
    let mut hash = Sha256::new();
    for triangle in &all {
        for number in triangle.as_flattened() {
            hash.update(number.to_le_bytes());
        }
    }
    Triangles {
        fingerprint: urdd_format::hexadecimal::hexadecimal(&hash.finalize()),
        count: all.len(),
    }
}

#[expect(clippy::cast_possible_truncation, reason = "files hold coordinates as binary32")]
fn rounded(corner: [f64; 3]) -> Corner {
    // Adding 0 turns -0 into 0.
    corner.map(|coordinate| (coordinate as f32 + 0.0).to_bits())
}

/// The triangle, beginning with its smallest corner. Which side is outside stays.
fn turned([a, b, c]: [Corner; 3]) -> [Corner; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= a && b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The bounding box of a scene that is placed by a matrix; `None` without triangles.
pub(super) fn placed_bounds(scene: &Scene, place: &Matrix4<f64>) -> Option<Bounds> {
    let meshes = scene.parts.iter().map(|part| {
        let mut mesh =
            Mesh { vertices: part.mesh.vertices.clone(), triangles: part.mesh.triangles.clone() };
        mesh.transform(place);
        mesh.bounds()
    });
    meshes.flatten().reduce(union)
}

/// The box around two.
pub(super) fn union(a: Bounds, b: Bounds) -> Bounds {
    Bounds::of([a.min, a.max, b.min, b.max])
}
