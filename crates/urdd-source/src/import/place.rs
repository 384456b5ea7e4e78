//! Places in the files of a description.

use std::path::PathBuf;
use std::sync::Arc;

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
