//! What reading a URDF gives.

use std::collections::HashMap;

use super::problem::{Problem, Repeated};
use urdd_directory::position::{LineIndex, Position};
use urdd_format::urdf::UrdfModule;

/// A URDF, as far as it could be read.
#[derive(Debug, Default)]
pub struct Reading {
    /// The content of a faithful `urdf_module`; `None` if the text is not well-formed XML, or not a URDF. Reliable only
    /// if there are no problems.
    pub robot: Option<UrdfModule>,
    /// What cannot be read, in the order of the file.
    pub problems: Vec<Problem>,
    /// Repeated elements, of which only one counts.
    pub repeated: Vec<Repeated>,
    /// The positions of the values of `robot` in the text, by JSON Pointer.
    pub(super) places: HashMap<String, usize>,
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
