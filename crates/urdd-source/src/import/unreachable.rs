//! Why a file that a description names is not read.

use std::path::{Path, PathBuf};

use thiserror::Error;

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
}

impl Unreachable {
    /// Of a file that is outside, under the name that the description has for it.
    pub fn outside(shown: &str, file: &Path) -> Self {
        let folder = file.parent().unwrap_or(file).to_owned();
        Unreachable::Outside { file: shown.to_owned(), folder }
    }
}
