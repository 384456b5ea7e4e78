//! The working folder for URDDs while an external program runs on them.

use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::run_error::RunError;
use crate::tree::{TreeError, make_folder};
use urdd_directory::temporary::Temporary;

/// A temporary or a persistent folder.
pub struct Workplace {
    path: PathBuf,
    /// Removes the folder on drop, if it is temporary.
    _temporary: Option<Temporary>,
}

impl Workplace {
    /// A temporary folder, or the folder `keep`, which must be new or empty.
    ///
    /// # Errors
    /// If it cannot be created, or is not empty.
    pub fn new(keep: Option<&Path>) -> Result<Workplace, RunError> {
        let Some(path) = keep else {
            let folder = Temporary::begin(&std::env::temp_dir(), "conformance");
            let folder = folder.map_err(RunError::Temporary)?;
            return Ok(Workplace { path: folder.path().to_owned(), _temporary: Some(folder) });
        };
        let failed = |error| TreeError::Read(path.to_owned(), error);
        make_folder(path)?;
        if fs::read_dir(path).map_err(failed)?.next().is_some() {
            return Err(RunError::NotEmpty(path.to_owned()));
        }
        // Absolute, because the command may change its current folder.
        let path = std::path::absolute(path).map_err(failed)?;
        Ok(Workplace { path, _temporary: None })
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// A path relative to the current folder; `None` if one of the two cannot be found, or they are on different drives.
pub fn relative(path: &Path) -> Option<PathBuf> {
    // `..` of a symbolic link leads to the folder around its target.
    let here = std::env::current_dir().ok()?.canonicalize().ok()?;
    let path = path.canonicalize().ok()?;
    let (mut up, mut down) = (here.components().peekable(), path.components().peekable());
    while up.peek().is_some() && up.peek() == down.peek() {
        up.next();
        down.next();
    }
    let is_name = |part: &Component| matches!(part, Component::Normal(_));
    let (up, down): (Vec<_>, Vec<_>) = (up.collect(), down.collect());
    let all = up.iter().chain(&down).all(is_name);
    let climb = up.iter().map(|_| Component::ParentDir);
    all.then(|| climb.chain(down.iter().copied()).collect())
}
