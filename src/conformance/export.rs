//! Writing the suite into a folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use include_dir::{Dir, DirEntry};

use super::data::{ROBOTS, SUITE};

/// Why the suite could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {error}", path.display())]
    Write {
        /// Which.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
}

/// Writes the suite below `folder`, which is made where it is not there.
///
/// # Errors
/// Where a file cannot be written.
pub fn export(folder: &Path) -> Result<(), ExportError> {
    match SUITE.get_dir(ROBOTS) {
        Some(robots) => write_all(robots, folder),
        None => Ok(()),
    }
}

fn write_all(from: &Dir, to: &Path) -> Result<(), ExportError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| ExportError::Write { path, error }
    };
    let folder = to.join(from.path());
    fs::create_dir_all(&folder).map_err(failed(&folder))?;
    for entry in from.entries() {
        match entry {
            DirEntry::Dir(inside) => write_all(inside, to)?,
            DirEntry::File(file) => {
                let path = to.join(file.path());
                fs::write(&path, file.contents()).map_err(failed(&path))?;
            }
        }
    }
    Ok(())
}
