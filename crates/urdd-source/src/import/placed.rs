//! A fault of a description, with its place in a file.

use super::fault::ImportFault;
use super::model::{Place, TextFile};
use urdd_directory::position::LineIndex;

/// A fault, and its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Placed {
    /// The file, as the user would name it.
    pub file: String,
    /// Line in it, from 1.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub fault: ImportFault,
}

/// A fault at a place of one of the files.
pub fn placed(files: &[TextFile], place: Place, fault: impl Into<ImportFault>) -> Placed {
    let file = files.get(place.file);
    let at = file.map(|file| LineIndex::new(&file.text).position(place.offset));
    Placed {
        file: file.map(|file| file.shown.clone()).unwrap_or_default(),
        line: at.as_ref().map_or(0, |at| at.line),
        column: at.as_ref().map_or(0, |at| at.column),
        fault: fault.into(),
    }
}
