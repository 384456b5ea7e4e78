//! The carried URDF, read by a small reader of the validator's own.
//!
//! It reads the XML literally, so that missing values differ from zeros, and every value has its place in the file. It
//! does not fill in, drop or repair values, as a URDF library would.

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

/// A URDF, as far as it is readable.
#[derive(Debug, Default)]
pub struct Reading {
    /// The data of a faithful `urdf_module`; `None` if the text is not XML or not a URDF. Only reliable without
    /// problems.
    pub robot: Option<UrdfModule>,
    /// The unreadable places, in the order of the file.
    pub problems: Vec<Problem>,
    /// Repeated elements of which only the first counts.
    pub repeated: Vec<Repeated>,
    /// Positions of the values of `robot` in the text, by JSON Pointer.
    places: HashMap<String, usize>,
}

impl Reading {
    /// The byte offset of the value at a JSON Pointer of `robot`. If the URDF has no such value, that of the nearest
    /// element around it.
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
