//! The generator's own reading of a URDF (SPEC 6.1): the XML as it stands, so that what is absent
//! can be told from what is zero.
//!
//! What is not as SPEC 6.1.8 asks for, but has one meaning that any reader would agree on, is
//! repaired in the text itself: [`read`] gives the edits with the remarks. So the URDD carries a
//! source that says what its modules say.

mod joint;
mod link;
mod materials;
mod numbers;
mod reader;
mod tree;
mod xml;

use super::fault::{Fault, PlacedFault};
use super::note::Remark;
use urdd_directory::position;
use urdd_format::urdf::UrdfModule;

pub(crate) use tree::{Tree, has_axis, written_axis};
pub(crate) use urdd_xml::element::Edit;

/// A robot as it was read.
#[derive(Debug)]
pub(crate) struct Reading {
    /// What the text says.
    pub robot: UrdfModule,
    /// The tree of its links, where there are no faults.
    pub tree: Tree,
    /// What is odd, in the order of the text.
    pub remarks: Vec<Remark>,
    /// What makes the text say what was read, where it did not.
    pub edits: Vec<Edit>,
    /// Where each mesh is named: links ascending, visual before collision, elements ascending.
    pub mesh_offsets: Vec<usize>,
    /// Whether there are elements of xacro.
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

/// Reads a URDF. `file_stem` names a robot that has no name.
///
/// # Errors
/// Where the text is no robot: everything that is wrong, in the order of the text.
pub(crate) fn read(text: &str, file_stem: &str) -> Result<Reading, Vec<PlacedFault>> {
    let document = urdd_xml::parse(text, urdd_xml::Kind::Robot)
        .map_err(|error| vec![xml::fault(&error, text)])?;
    let mut reader = reader::read(&document, file_stem);
    if reader.faults.is_empty() {
        tree::check(&mut reader, document.root_element().range().start);
    }
    materials::check(&mut reader);
    let (reading, faults) = reader.finish();
    if faults.is_empty() {
        return Ok(reading);
    }
    let lines = position::LineIndex::new(text);
    let line_of = |offset: &mut u32| *offset = lines.position(*offset as usize).line;
    let mut faults = faults;
    faults.sort_by_key(|(offset, _)| *offset);
    let faults = faults.into_iter().map(|(offset, mut fault)| {
        let at = lines.position(offset);
        if let Fault::TwoLinks { first, .. } | Fault::TwoJoints { first, .. } = &mut fault {
            line_of(first);
        }
        PlacedFault {
            line: at.line,
            column: at.column,
            fault,
        }
    });
    Err(faults.collect())
}
