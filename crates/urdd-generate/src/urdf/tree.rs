//! The kinematic tree, and the DOFs and axes of joint types.

use urdd_format::urdf::{Joint, JointType};

/// The kinematic tree, by link and joint indices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Tree {
    /// The root link.
    pub root: usize,
    /// For each joint, its parent link and child link.
    pub ends: Vec<[usize; 2]>,
    /// For each joint, the joint that it mimics.
    pub drivers: Vec<Option<usize>>,
}

/// Number of DOFs of a joint type, unless the joint is a mimic joint.
pub(crate) fn num_dofs(joint_type: JointType) -> usize {
    match joint_type {
        JointType::Fixed => 0,
        JointType::Revolute | JointType::Continuous | JointType::Prismatic => 1,
        JointType::Planar | JointType::Spherical => 3,
        JointType::Floating => 6,
    }
}

/// The axis of SPEC 5.7, not normalised.
pub(crate) fn written_axis(joint: &Joint) -> [f64; 3] {
    let axis = joint.axis.as_ref().and_then(|axis| axis.xyz);
    axis.unwrap_or([1.0, 0.0, 0.0])
}

pub(crate) fn has_axis(joint_type: JointType) -> bool {
    use JointType::{Continuous, Planar, Prismatic, Revolute};
    matches!(joint_type, Revolute | Continuous | Prismatic | Planar)
}
