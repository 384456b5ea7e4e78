//! Where URDDs lie while somebody's program is run on them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

/// A temporary folder, or one that stays.
pub enum Workplace {
    /// It goes when this is dropped.
    Temporary(TempDir),
    /// It stays.
    Kept(PathBuf),
}

/// Why there is no place to work in.
#[derive(Debug, thiserror::Error)]
pub enum WorkplaceError {
    /// A temporary folder cannot be made.
    #[error("no temporary folder: {0}")]
    Temporary(io::Error),
    /// Something is there already.
    #[error("{}: this folder is not empty; give one that is new", .0.display())]
    NotEmpty(PathBuf),
    /// The folder cannot be made or read.
    #[error("{}: cannot be used: {error}", path.display())]
    Folder {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

impl Workplace {
    /// A temporary folder; where `keep` names one, that, which must be new or empty.
    ///
    /// # Errors
    /// Where it cannot be made, or holds something.
    pub fn new(keep: Option<&Path>) -> Result<Workplace, WorkplaceError> {
        let Some(path) = keep else {
            let folder = tempfile::tempdir().map_err(WorkplaceError::Temporary)?;
            return Ok(Workplace::Temporary(folder));
        };
        let failed = |error| WorkplaceError::Folder {
            path: path.to_owned(),
            error,
        };
        fs::create_dir_all(path).map_err(failed)?;
        if fs::read_dir(path).map_err(failed)?.next().is_some() {
            return Err(WorkplaceError::NotEmpty(path.to_owned()));
        }
        // The command may change its folder: it gets the whole path.
        let path = std::path::absolute(path).map_err(failed)?;
        Ok(Workplace::Kept(path))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        match self {
            Workplace::Temporary(folder) => folder.path(),
            Workplace::Kept(path) => path,
        }
    }
}
