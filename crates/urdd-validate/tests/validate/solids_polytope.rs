//! A mesh as the half-spaces of its faces: whether it is the closed surface of a convex body, and what is outside it.

use urdd_geometry::Mesh;
use urdd_geometry::primitives::{cuboid, sphere};
use urdd_validate::solids::polytope::*;

#[test]
fn bodies_are_convex_and_dented_open_or_inverted_ones_are_not() {
    let mesh = sphere(0.7);
    assert_eq!(not_convex(&mesh), None);
    let mut dented = mesh.clone();
    dented.vertices[5] = dented.vertices[5].map(|x| 0.9 * x);
    assert!(matches!(not_convex(&dented), Some(NotConvex::Vertex(_, d)) if d > 1e-3));
    let mut open = mesh.clone();
    open.triangles.pop();
    assert!(matches!(not_convex(&open), Some(NotConvex::Open(_))));
    let mut inverted = mesh.clone();
    inverted.flip();
    assert_eq!(not_convex(&inverted), Some(NotConvex::Inward));
    assert_eq!(not_convex(&Mesh::default()), Some(NotConvex::Nothing));
}

#[test]
fn what_is_outside_is_measured_from_the_faces() {
    let polytope = Polytope::new(&cuboid([2.0, 2.0, 2.0])).expect("faces");
    assert_eq!(polytope.outside([0.0, 0.0, 3.0]), 2.0);
    assert_eq!(polytope.outside([0.5, -1.0, 1.0]), 0.0);
    assert!(polytope.holds([1.05, 0.0, 0.0], 0.1));
    assert!(!polytope.holds([1.15, 0.0, 0.0], 0.1));
}
