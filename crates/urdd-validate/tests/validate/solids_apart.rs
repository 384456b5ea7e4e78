//! Shows with little work that two meshes are not the same surface.

use urdd_geometry::primitives::cuboid;
use urdd_geometry::surface::{Likeness, difference};
use urdd_validate::solids::placed::*;

#[test]
fn only_different_surfaces_are_apart() {
    const TOLERANCE: f64 = 1e-6;
    let mesh = cuboid([1.0, 2.0, 3.0]);
    let moved = |by: f64| {
        let mut moved = mesh.clone();
        moved.vertices.iter_mut().for_each(|p| p[0] += by);
        moved
    };
    assert!(!are_apart(&mesh, &mesh, TOLERANCE));
    assert!(!are_apart(&mesh, &moved(0.9 * TOLERANCE), TOLERANCE));
    assert!(are_apart(&mesh, &moved(1.1 * TOLERANCE), TOLERANCE));
    // Points between the corners of two meshes connect them.
    let mut chained = moved(1.8 * TOLERANCE);
    chained.vertices.extend(moved(0.9 * TOLERANCE).vertices);
    let difference = difference(&mesh, &chained, TOLERANCE, Likeness::SameSurface);
    assert!(!difference.is_any());
    assert!(!are_apart(&mesh, &chained, TOLERANCE));
}
