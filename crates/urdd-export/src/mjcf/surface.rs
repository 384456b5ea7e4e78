//! Meshes that MuJoCo's compiler accepts.

use urdd_geometry::Mesh;
use urdd_geometry::hull::ConvexHull;

/// Smaller areas vanish, m²: well above MuJoCo's mjMINVAL of 1e-15.
const SMALLEST_AREA: f64 = 1e-14;

/// Smaller volumes are treated as flat, m³: well above mjMINVAL too.
const SMALLEST_VOLUME: f64 = 1e-13;

/// A shape that is thinner than this part of its greatest coordinate is treated as flat: binary32 has 24 bits.
const THINNEST: f64 = 1.0 / 1_048_576.0;

/// The least number of vertices of a mesh.
const VERTICES: usize = 4;

/// The most faces, and the largest coordinate, of an STL. An OBJ has no such limits.
const STL_FACES: usize = 200_000;
const STL_REACH: f64 = 1_073_741_824.0;

/// Completes a visual mesh, in binary32: one of fewer than four vertices gets another that no triangle uses, in its
/// middle. False if it has no area.
pub fn complete(mesh: &mut Mesh) -> bool {
    mesh.round_to_f32();
    if mesh.area() < SMALLEST_AREA {
        return false;
    }
    if let [first, .., last] = mesh.vertices[..] {
        let middle = [0, 1, 2].map(|k| f64::midpoint(first[k], last[k]));
        mesh.vertices.resize(mesh.vertices.len().max(VERTICES), middle);
    }
    true
}

/// Whether a convex mesh has no volume, once its coordinates are binary32.
pub fn is_flat(mesh: &Mesh) -> bool {
    let mut rounded = mesh.clone();
    rounded.round_to_f32();
    let Ok(hull) = ConvexHull::new(&rounded.vertices) else {
        return true;
    };
    let (volume, area) = (hull.mesh().signed_volume(), hull.mesh().area());
    hull.is_flat() || volume < SMALLEST_VOLUME || 2.0 * volume < THINNEST * reach(mesh) * area
}

/// Whether MuJoCo reads a mesh from an STL.
pub fn fits_stl(mesh: &Mesh) -> bool {
    mesh.triangles.len() <= STL_FACES && reach(mesh) <= STL_REACH
}

/// The greatest coordinate, m.
fn reach(mesh: &Mesh) -> f64 {
    mesh.vertices.as_flattened().iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}
