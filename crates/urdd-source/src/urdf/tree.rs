//! The kinematic tree, and the axes of joints.

use urdd_format::urdf::Joint;

/// The kinematic tree, by link and joint indices.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tree {
    /// The root link.
    pub root: usize,
    /// For each joint, its parent link and child link.
    pub ends: Vec<[usize; 2]>,
    /// For each joint, the joint that it mimics.
    pub drivers: Vec<Option<usize>>,
}

/// The axis of SPEC 5.7, not normalised.
pub fn written_axis(joint: &Joint) -> [f64; 3] {
    let axis = joint.axis.as_ref().and_then(|axis| axis.xyz);
    axis.unwrap_or([1.0, 0.0, 0.0])
}
