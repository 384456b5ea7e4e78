//! The carried URDF, read by the validator's own short path.
//!
//! The XML is read as it stands, so that what is absent can be told from what is zero, and every
//! value has its place in the file. What a URDF library would fill in, drop or repair is neither.

pub mod compare;
mod joint;
mod legacy;
mod link;
mod numbers;
mod problem;
mod reader;
mod xml;

pub use legacy::as_legacy;
pub use problem::{Fault, Problem, Repeated};

use std::collections::HashMap;

use urdd_directory::position::{LineIndex, Position};
use urdd_format::urdf::UrdfModule;

/// A URDF, as far as it could be read.
#[derive(Debug, Default)]
pub struct Reading {
    /// What a faithful `urdf_module` says; `None` where the text is no XML, or no URDF at all.
    /// Only to be relied on where there are no problems.
    pub robot: Option<UrdfModule>,
    /// What cannot be read, in the order of the file.
    pub problems: Vec<Problem>,
    /// Elements that are there again though once is all that counts.
    pub repeated: Vec<Repeated>,
    /// Where the values of `robot` stand in the text, by JSON Pointer.
    places: HashMap<String, usize>,
}

impl Reading {
    /// The byte offset of the value at a JSON Pointer of `robot`; where the URDF has no such
    /// value, of the nearest element around it.
    pub fn offset(&self, pointer: &str) -> Option<usize> {
        let mut pointer = pointer;
        loop {
            if let Some(offset) = self.places.get(pointer) {
                return Some(*offset);
            }
            pointer = &pointer[..pointer.rfind('/')?];
        }
    }

    /// The line and column of the value at a JSON Pointer of `robot`, as [`Reading::offset`].
    pub fn position(&self, lines: &LineIndex<'_>, pointer: &str) -> Option<Position> {
        self.offset(pointer).map(|offset| lines.position(offset))
    }
}

/// Reads a URDF.
pub fn read(text: &str) -> Reading {
    match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Ok(document) => reader::read(&document),
        Err(error) => Reading {
            problems: vec![problem::not_xml(&error, text)],
            ..Reading::default()
        },
    }
}

#[cfg(test)]
mod tests;
