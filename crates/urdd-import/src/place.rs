//! Places in the files of a description.

use std::path::PathBuf;
use std::sync::Arc;

use super::fault::{ImportFault, Unreachable};
use urdd_source::gate::Gate;
use urdd_source::{FoundMesh, MAX_SOURCE_BYTES, SourceError, decode};

/// What a file costs, bytes, and each byte of its text: bytes, text, document and elements.
const FILE: usize = 20_000;
const TEXT: usize = 16;

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
        let text = decode(&bytes, &shown, &mut Vec::new())?.text;
        Ok(TextFile { shown, path, text, bytes: bytes.into() })
    }

    /// A file that may not be text; then its text is empty.
    pub fn any(shown: String, path: PathBuf, bytes: Arc<[u8]>) -> Self {
        let text = std::str::from_utf8(&bytes).unwrap_or_default().to_owned();
        TextFile { shown, path, text, bytes }
    }

    /// As [`TextFile::new`], of a file that a description includes. What is made of it is charged each time it is
    /// included.
    ///
    /// # Errors
    /// If it cannot be read, is not text, or the account of the gate does not have its cost.
    pub fn included(gate: &Gate, found: &FoundMesh) -> Result<Self, ImportFault> {
        let shown = found.file.display().to_string();
        let bytes = gate.bytes(found, MAX_SOURCE_BYTES);
        let bytes = bytes.map_err(|why| ImportFault::File(Unreachable::unread(&shown, &why)))?;
        gate.account().charge(FILE + bytes.len() * TEXT)?;
        TextFile::new(shown.clone(), found.file.clone(), bytes).map_err(|error| {
            let reason = error.to_string();
            ImportFault::File(Unreachable::Unreadable { file: shown, reason })
        })
    }
}
