//! Why a file that a description names is not read.

use std::path::PathBuf;

use thiserror::Error;
use urdd_directory::read_error::ReadError;

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Unreachable {
    #[error("`{0}` was not found")]
    Missing(String),
    #[error(
        "`{file}` is outside of the folders of the description; `--allow-folder {}` allows its folder", folder.display()
    )]
    Outside { file: String, folder: PathBuf },
    #[error("`{file}` cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
    #[error("`{file}` cannot be read as a mesh: {reason}")]
    NotMesh { file: String, reason: String },
    #[error("`{file}` is not an image")]
    NotImage { file: String },
    #[error("`{file}` has no part `{part}`")]
    NoPart { file: String, part: String },
}

impl Unreachable {
    /// Of a file that was found, and not read.
    pub fn unread(file: &str, why: &ReadError) -> Self {
        Unreachable::Unreadable { file: file.to_owned(), reason: why.to_string() }
    }
}
