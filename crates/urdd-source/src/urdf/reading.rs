//! The result of reading a URDF: the robot, and its kinematic tree.

use crate::note::Remark;
use urdd_format::urdf::{Joint, UrdfModule};
use urdd_xml::element::Edit;

/// The result of reading a URDF.
#[derive(Debug, Default)]
pub struct Reading {
    /// The robot.
    pub robot: UrdfModule,
    /// The link tree; valid if there are no faults.
    pub tree: Tree,
    /// Deviations, in the order of the text.
    pub remarks: Vec<Remark>,
    /// Edits that repair the text where it differs from what was read.
    pub edits: Vec<Edit>,
    /// Byte offset of each mesh element: links ascending, visual before collision, elements ascending.
    pub mesh_offsets: Vec<usize>,
    /// Whether there are xacro elements.
    pub has_xacro: bool,
}

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
