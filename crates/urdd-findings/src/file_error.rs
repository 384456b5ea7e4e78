//! Reads a file that a person wrote for the program: what is wrong with it, and where.

use std::fmt::{self, Display};
use std::path::{Path, PathBuf};

use thiserror::Error;

use urdd_directory::position::Position;
use urdd_directory::read_error::ReadError;
use urdd_directory::regular;
use urdd_format::escape;

/// Why a file cannot be used. `E` is what can be wrong with its content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError<E> {
    /// The file, as it was named.
    pub file: PathBuf,
    /// Where in the file.
    pub at: Option<Position>,
    /// What is wrong.
    pub fault: FileFault<E>,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FileFault<E> {
    /// It cannot be read.
    #[error(transparent)]
    Read(ReadError),
    /// Not UTF-8.
    #[error("it is not UTF-8")]
    NotUtf8,
    /// Its content is wrong.
    #[error(transparent)]
    Content(E),
}

/// What `parse` makes of the text of a file of at most `limit` bytes.
pub(crate) fn read<T, E>(
    file: &Path,
    limit: u64,
    parse: impl FnOnce(&str) -> Result<T, (Option<Position>, E)>,
) -> Result<T, FileError<E>> {
    let refused = |at, fault| FileError { file: file.to_owned(), at, fault };
    let bytes =
        regular::read(file, limit).map_err(|error| refused(None, FileFault::Read(error)))?;
    let text = String::from_utf8(bytes).map_err(|_| refused(None, FileFault::NotUtf8))?;
    parse(&text).map_err(|(at, error)| refused(at, FileFault::Content(error)))
}

impl<E: std::error::Error + 'static> std::error::Error for FileError<E> {}

impl<E: std::error::Error> Display for FileError<E> {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{}", escape::line(&self.file.display().to_string()))?;
        if let Some(at) = self.at {
            write!(out, ":{at}")?;
        }
        write!(out, ": {}", self.fault)
    }
}
