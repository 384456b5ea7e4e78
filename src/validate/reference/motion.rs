//! How each type of joint moves (SPEC 9.1), written with nalgebra alone.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use urdf_rs::JointType;

/// Number of numbers that say a joint's position.
pub fn freedom(kind: &JointType) -> usize {
    match kind {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The motion of a joint at a position, of which the first [`freedom`] numbers count.
pub fn motion(kind: &JointType, axis: [f64; 3], q: &[f64; 6]) -> Isometry3<f64> {
    let axis = Vector3::from(axis);
    let unit = axis.try_normalize(0.0).unwrap_or_else(Vector3::x);
    let turn = |v: Vector3<f64>| UnitQuaternion::from_scaled_axis(v);
    let (shift, rotation) = match kind {
        JointType::Fixed => (Vector3::zeros(), UnitQuaternion::identity()),
        JointType::Revolute | JointType::Continuous => (Vector3::zeros(), turn(unit * q[0])),
        JointType::Prismatic => (unit * q[0], UnitQuaternion::identity()),
        JointType::Planar => {
            // rotation_between knows no direct way for opposite vectors: half a turn about x then.
            let basis = UnitQuaternion::rotation_between(&Vector3::z(), &unit)
                .unwrap_or_else(|| turn(Vector3::x() * std::f64::consts::PI));
            (basis * Vector3::new(q[0], q[1], 0.0), turn(unit * q[2]))
        }
        JointType::Floating => (
            Vector3::new(q[0], q[1], q[2]),
            turn(Vector3::new(q[3], q[4], q[5])),
        ),
        JointType::Spherical => (Vector3::zeros(), turn(Vector3::new(q[0], q[1], q[2]))),
    };
    Isometry3::from_parts(Translation3::from(shift), rotation)
}
