//! A fault of a description, with its place in a file.

use super::fault::ImportFault;
use super::place::{Place, TextFile};
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
    let (file, line, column) = position(files, place).unwrap_or_default();
    Placed { file: file.to_owned(), line, column, fault: fault.into() }
}

/// The file, line and column of a place.
pub fn position(files: &[TextFile], place: Place) -> Option<(&str, u32, u32)> {
    let file = files.get(place.file)?;
    let at = LineIndex::new(&file.text).position(place.offset);
    Some((&file.shown, at.line, at.column))
}
