//! Places in the files of a description.

use std::path::PathBuf;
use std::sync::Arc;

use urdd_directory::position::LineIndex;
use urdd_xml::XmlError;

use super::unreachable::Unreachable;
use crate::decode::decode;
use crate::error::SourceError;

/// A place in one of the files of a description.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The index of the file in the list of files.
    pub file: usize,
    /// The byte offset in its text.
    pub offset: usize,
}

/// A text file that a description was read from.
#[derive(Debug, Clone)]
pub struct TextFile {
    /// The file, as the user would name it.
    pub shown: String,
    /// Its path, with symbolic links resolved.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}

impl TextFile {
    /// A file that was read.
    ///
    /// # Errors
    /// If it is not text.
    pub fn new(shown: String, path: PathBuf, bytes: Vec<u8>) -> Result<Self, SourceError> {
        let (text, _) = decode(&bytes, &shown, &mut Vec::new())?;
        Ok(TextFile { shown, path, text, bytes: bytes.into() })
    }

    /// As [`TextFile::new`], of a file that a description includes.
    ///
    /// # Errors
    /// If it is not text.
    pub fn included(path: PathBuf, bytes: Vec<u8>) -> Result<Self, Unreachable> {
        let shown = path.display().to_string();
        TextFile::new(shown.clone(), path, bytes).map_err(|error| {
            let reason = error.to_string();
            Unreachable::Unreadable { file: shown, reason }
        })
    }
}

/// The byte offset of an error in the text of a file.
pub fn offset_of(text: &str, error: &XmlError) -> usize {
    let pos = error.pos();
    let start = LineIndex::new(text).line_start(pos.row as usize).unwrap_or_default();
    let before = text[start..].chars().take((pos.col as usize).saturating_sub(1));
    start + before.map(char::len_utf8).sum::<usize>()
}
