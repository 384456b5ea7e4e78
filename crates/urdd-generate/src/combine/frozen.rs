//! Frozen joints: computes the fixed origin.

use nalgebra::{Rotation3, UnitQuaternion};

use crate::origin_pose;
use crate::urdf::written_axis;
use urdd_format::urdf::Joint;
use urdd_kinematics::joint_motion;
use urdd_kinematics::rotation::unit_axis;

/// The `<origin>` of a joint that is frozen at a position, given as one value per DOF (SPEC 5.8).
pub(super) fn origin(joint: &Joint, position: &[f64], quaternions: bool) -> String {
    let axis = unit_axis(written_axis(joint));
    let motion = joint_motion(joint.joint_type, axis, position);
    let pose = origin_pose(joint.origin.as_ref(), quaternions) * motion;
    let rpy = roll_pitch_yaw(&pose.rotation);
    let xyz = pose.translation.vector;
    origin_text([xyz.x, xyz.y, xyz.z], rpy)
}

/// The text of an `<origin>` element.
pub(super) fn origin_text(xyz: [f64; 3], rpy: [f64; 3]) -> String {
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers(&xyz), numbers(&rpy))
}

/// Numbers separated by spaces, each in its shortest exact form.
pub(super) fn numbers(values: &[f64]) -> String {
    let number = |value: &f64| {
        // Adding 0 turns -0 into 0.
        let text = format!("{:?}", value + 0.0);
        text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
    };
    values.iter().map(number).collect::<Vec<_>>().join(" ")
}

/// Fixed-axis roll, pitch and yaw. Near a pitch of ±90°, roll and yaw are each ill-conditioned. Roll is computed from
/// the yaw found, so that the rotation keeps its precision.
pub fn roll_pitch_yaw(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let r: Rotation3<f64> = rotation.to_rotation_matrix();
    let yaw = r[(1, 0)].atan2(r[(0, 0)]);
    let pitch = (-r[(2, 0)]).atan2(r[(0, 0)].hypot(r[(1, 0)]));
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r[(0, 2)] - cos * r[(1, 2)]).atan2(cos * r[(1, 1)] - sin * r[(0, 1)]);
    // Avoids -0.
    [roll, pitch, yaw].map(|angle| angle + 0.0)
}
