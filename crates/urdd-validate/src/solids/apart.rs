//! Shows with little work that two meshes are not the same surface.

use urdd_geometry::Mesh;
use urdd_geometry::surface::is_thin;

/// Whether [`surface::difference`](urdd_geometry::surface::difference) is certain to find a triangle of `expected` missing in
/// `found`. Looks at a few triangles only, so false says nothing.
pub fn are_apart(expected: &Mesh, found: &Mesh, tolerance: f64) -> bool {
    const TRIANGLES: usize = 3;
    let near = |p: &[f64; 3], q: &[f64; 3]| (0..3).all(|i| (p[i] - q[i]).abs() <= tolerance);
    // Points within the tolerance are merged, in chains too, so points of both meshes count.
    let is_alone = |p: &&[f64; 3]| {
        !found.vertices.iter().any(|q| near(p, q))
            && !expected.vertices.iter().any(|q| *p != q && near(p, q))
    };
    let triangles = expected.triangles.iter();
    let thick = triangles
        .map(|triangle| expected.corners(*triangle))
        .filter(|corners| !is_thin(*corners, tolerance));
    // With two such corners, none of the three is merged with another, and the triangle counts.
    thick.take(TRIANGLES).any(|corners| corners.iter().filter(is_alone).count() >= 2)
}
