//! The motion of each type of joint (SPEC 9.1), implemented with nalgebra alone.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};

use urdd_format::urdf::JointType;

/// Number of values of a joint's position.
pub fn freedom(kind: JointType) -> usize {
    match kind {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The motion of a joint at a position; only the first [`freedom`] numbers are used.
pub fn motion(kind: JointType, axis: [f64; 3], q: &[f64; 6]) -> Isometry3<f64> {
    let axis = Vector3::from(axis);
    // Divided first, so that squares of huge numbers do not overflow.
    let largest = axis.amax();
    let unit = if largest > 0.0 { (axis / largest).normalize() } else { Vector3::x() };
    let turn = |v: Vector3<f64>| UnitQuaternion::from_scaled_axis(v);
    let (shift, rotation) = match kind {
        JointType::Fixed => (Vector3::zeros(), UnitQuaternion::identity()),
        JointType::Revolute | JointType::Continuous => (Vector3::zeros(), turn(unit * q[0])),
        JointType::Prismatic => (unit * q[0], UnitQuaternion::identity()),
        JointType::Planar => {
            let basis = turn(arc_from_z(unit));
            (basis * Vector3::new(q[0], q[1], 0.0), turn(unit * q[2]))
        }
        JointType::Floating => {
            (Vector3::new(q[0], q[1], q[2]), turn(Vector3::new(q[3], q[4], q[5])))
        }
        JointType::Spherical => (Vector3::zeros(), turn(Vector3::new(q[0], q[1], q[2]))),
    };
    Isometry3::from_parts(Translation3::from(shift), rotation)
}

/// The shortest arc from z to a unit axis, as a rotation vector (SPEC 5.9). `rotation_between` computes the angle from
/// its cosine, and loses the arc near -z.
fn arc_from_z(axis: Vector3<f64>) -> Vector3<f64> {
    let sine = axis.x.hypot(axis.y);
    let angle = sine.atan2(axis.z);
    if sine >= 1e-10 {
        Vector3::new(-axis.y, axis.x, 0.0) * (angle / sine)
    } else if axis.z < 0.0 {
        Vector3::x() * PI
    } else {
        Vector3::zeros()
    }
}
