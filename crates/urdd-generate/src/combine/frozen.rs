//! Frozen joints: computes the fixed origin.

use urdd_format::urdf::Joint;
use urdd_kinematics::joint_motion;
use urdd_kinematics::rotation::{to_rpy, unit_axis};
use urdd_source::origin;
use urdd_source::urdf::written_axis;
use urdd_xml::number::numbers;

/// The `<origin>` of a joint that is frozen at a position, given as one value per DOF (SPEC 5.8).
pub(super) fn origin(joint: &Joint, position: &[f64], quaternions: bool) -> String {
    let axis = unit_axis(written_axis(joint));
    let motion = joint_motion(joint.joint_type, axis, position);
    let pose = origin::of(joint.origin.as_ref(), quaternions) * motion;
    let rpy = to_rpy(pose.rotation.to_rotation_matrix().matrix());
    let xyz = pose.translation.vector;
    origin_text([xyz.x, xyz.y, xyz.z], rpy)
}

/// The text of an `<origin>` element.
pub(super) fn origin_text(xyz: [f64; 3], rpy: [f64; 3]) -> String {
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers(&xyz), numbers(&rpy))
}
