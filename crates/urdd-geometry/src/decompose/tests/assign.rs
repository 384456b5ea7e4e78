use super::*;
use crate::decompose::clean::Surface;
use crate::primitives::cuboid;

#[test]
fn a_point_that_two_cuts_move_out_of_the_body_is_dropped() {
    let surface = Surface::new(&cuboid([2.0, 2.0, 2.0])).expect("a surface");
    // Two planes through the edge x = y = 1.02, just outside; a point near it is projected into both.
    let plane = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        Plane { normal: [sin, -cos, 0.0], offset: 1.02 * (sin - cos) }
    };
    let nodes = [
        Node::Cut(plane(44.0), [1, 2]),
        Node::Cut(plane(134.0), [3, 4]),
        Node::Cut(plane(134.0), [5, 6]),
        Node::Leaf(0),
        Node::Leaf(1),
        Node::Leaf(2),
        Node::Leaf(3),
    ];
    let point = [[0.95, 0.95, 0.0]];
    let given = |reach: f64| {
        let inside = Inside::new(&point, reach, &surface.unit);
        let parts = assign(&surface, &inside, &nodes, &[0, 1, 2, 3], 4, 1e-9);
        parts.into_iter().flat_map(|hand| hand.points).collect::<Vec<_>>()
    };
    let out = |p: &[f64; 3]| p.iter().any(|x| x.abs() > 1.0 + 1e-6);
    assert!(!given(0.11).iter().any(out), "{:?}", given(0.11));
    // Only the projection into the first plane remains.
    assert!(given(0.11).len() > given(0.0).len());
}
