//! What an export writes.

use super::error::Note;

/// Files by path.
pub(super) type Files = Vec<(String, Vec<u8>)>;

/// The result of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The text of the file.
    pub text: String,
    /// The path of the text in an exported folder; `None` for a format of one file, which has a path of its own.
    pub path: Option<String>,
    /// The other files of the folder; or those that the text references, with paths relative to it, sorted, and then an
    /// MJCF's scene, which includes it.
    pub files: Files,
    /// What the format cannot express, or expresses differently.
    pub notes: Vec<Note>,
    /// What was carried, carried otherwise and lost of this robot, and the notes: JSON.
    pub report: String,
}

impl Export {
    /// A text with the files that it references; not in a folder, and without a report yet.
    pub(super) fn of(text: String, files: Files, notes: Vec<Note>) -> Self {
        Export { text, path: None, files, notes, report: String::new() }
    }
}
