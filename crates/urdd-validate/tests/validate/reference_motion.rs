//! The motion of each type of joint (SPEC 9.1), implemented with nalgebra alone.

use nalgebra::Vector3;
use urdd_format::urdf::JointType;
use urdd_validate::reference::*;

/// Where the motion of a planar joint at (x, y) moves the origin.
fn planar(axis: [f64; 3], [x, y]: [f64; 2]) -> Vector3<f64> {
    let q = [x, y, 0.0, 0.0, 0.0, 0.0];
    motion(JointType::Planar, axis, &q).translation.vector
}

#[test]
fn a_planar_axis_too_near_to_z_counts_as_z() {
    for (axis, expected) in [
        ([0.0, 0.0, -2.0], [3.0, -5.0, 0.0]),
        ([4e-11, -4e-11, -1.0], [3.0, -5.0, 0.0]),
        ([4e-11, -4e-11, 1.0], [3.0, 5.0, 0.0]),
    ] {
        let shift = planar(axis, [3.0, 5.0]);
        assert!((shift - Vector3::from(expected)).norm() < 1e-14, "{shift}");
    }
}

#[test]
fn the_arc_keeps_its_direction_near_the_opposite_of_z() {
    // Half a turn, less 5e-9, about (-0.8, 0.6, 0): R = 2 v v' - I, so R ex = (0.28, -0.96, 0) and R ey = (-0.96,
    // -0.28, 0).
    let axis = [3e-9, 4e-9, -1.0];
    for (q, expected) in [([1.0, 0.0], [0.28, -0.96]), ([0.0, 1.0], [-0.96, -0.28])] {
        let shift = planar(axis, q);
        let expected = Vector3::new(expected[0], expected[1], 0.0);
        assert!((shift - expected).norm() < 1e-8, "{shift}");
    }
}
