//! What an export writes.

use super::error::Note;

/// The result of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// The files that it references, with paths relative to it, sorted.
    pub files: Vec<(String, Vec<u8>)>,
    /// What the format cannot express, or expresses differently.
    pub notes: Vec<Note>,
}
