//! The result of reading a URDF.

use super::tree::Tree;
use crate::note::Remark;
use urdd_format::urdf::UrdfModule;
use urdd_xml::element::Edit;

/// The result of reading a URDF.
#[derive(Debug)]
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

impl Default for Reading {
    fn default() -> Self {
        Reading {
            robot: UrdfModule {
                name: String::new(),
                version: None,
                links: Vec::new(),
                joints: Vec::new(),
                materials: Vec::new(),
                unknown_elements: Vec::new(),
            },
            tree: Tree::default(),
            remarks: Vec::new(),
            edits: Vec::new(),
            mesh_offsets: Vec::new(),
            has_xacro: false,
        }
    }
}
