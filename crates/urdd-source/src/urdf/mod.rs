//! The generator's URDF reader (SPEC 6.1). It keeps absent attributes distinct from zero.
//!
//! A deviation from SPEC 6.1.8 with one meaning that any reader would agree on is repaired in the text: [`read`]
//! returns the edits with the remarks. The source in the URDD thus says the same as its modules.

mod check;
mod joint;
mod link;
mod materials;
mod numbers;
mod reader;
mod reading;
mod xml;

use super::fault::{Fault, PlacedFault};
use urdd_directory::position;
use urdd_xml::Xml;

pub use reading::{Reading, Tree, written_axis};

/// Reads a URDF. A robot without a name is named `file_stem`.
///
/// # Errors
/// If the text is not a valid robot: all faults, in the order of the text.
pub fn read(xml: &Xml<'_>, file_stem: &str) -> Result<Reading, Vec<PlacedFault>> {
    let document = xml.document().map_err(|error| vec![xml::fault(error, xml.text())])?;
    let mut reader = reader::read(document, file_stem);
    if reader.faults.is_empty() {
        check::check(&mut reader, document.root_element().range().start);
    }
    materials::check(&mut reader);
    let (reading, mut faults) = reader.finish();
    if faults.is_empty() {
        return Ok(reading);
    }
    let lines = position::LineIndex::new(xml.text());
    faults.sort_by_key(|(offset, _)| *offset);
    let faults = faults.into_iter().map(|(offset, mut fault)| {
        let at = lines.position(offset);
        if let Fault::TwoLinks { first, .. } | Fault::TwoJoints { first, .. } = &mut fault {
            *first = lines.position(*first as usize).line;
        }
        PlacedFault { file: None, line: at.line, column: at.column, fault }
    });
    Err(faults.collect())
}
