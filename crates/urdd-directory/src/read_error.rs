//! Errors when reading a URDD.

use std::io;

use thiserror::Error;

use super::archive_fault::ArchiveFault;
use super::path::PathFault;

/// Why a file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ReadError {
    #[error("there is no such file")]
    Missing,
    /// The path violates SPEC 2.8.
    #[error("{0}")]
    Path(#[from] PathFault),
    #[error("it changed on disk since it was opened: open it again")]
    Changed,
    #[error("a symbolic link leads out of the URDD's root")]
    LeavesRoot,
    #[error("it is not a regular file")]
    NotAFile,
    #[error("it is neither a folder nor a zip archive")]
    NotAUrdd,
    #[error("it is {size} bytes long; the limit is {limit}")]
    TooLarge { size: u64, limit: u64 },
    #[error("it is longer than {} MiB", .limit >> 20)]
    TooLong { limit: u64 },
    #[error("{0}")]
    Archive(#[from] ArchiveFault),
    /// A folder too deep to be searched.
    #[error("it is deeper than {limit} folders; give its path to examine it")]
    TooDeep { limit: usize },
    #[error("it cannot be read: {0}")]
    Io(String),
}

impl From<io::Error> for ReadError {
    fn from(error: io::Error) -> Self {
        if let Some(own) = error.get_ref().and_then(|inner| inner.downcast_ref::<ReadError>()) {
            return own.clone();
        }
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => ReadError::Missing,
            io::ErrorKind::PermissionDenied => ReadError::Io("permission denied".to_owned()),
            _ => ReadError::Io(error.to_string()),
        }
    }
}
