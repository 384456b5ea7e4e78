//! Replaces some files of a URDD atomically: all or none.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::staging::{Staging, StagingError};
use super::take::take_content;
use super::writer::Writer;
use crate::cancellation::Cancellation;

/// Files by path relative to the root of their URDD.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A pending replacement of files in a folder. It locks out other runs of this program from [`Replacement::begin`] on.
#[derive(Debug)]
pub struct Replacement {
    folder: PathBuf,
    staging: Staging,
}

impl Replacement {
    /// Waits until no other run writes to the folder.
    ///
    /// # Errors
    /// If the parent folder is not writable.
    pub fn begin(folder: &Path) -> Result<Self, StagingError> {
        Ok(Replacement {
            folder: folder.to_owned(),
            staging: Staging::begin_inside(folder, &Cancellation::default())?,
        })
    }

    /// Prepares the new content: these files, plus all others unchanged.
    ///
    /// # Errors
    /// If a file cannot be read or written.
    pub fn stage(&self, files: &Files) -> Result<(), StagingError> {
        let writer = Writer::new(self.staging.content());
        let instead: BTreeSet<&Path> = files.keys().map(Path::new).collect();
        take_content(&self.folder, self.staging.content(), &|path| instead.contains(path))?;
        for (path, bytes) in files {
            writer.file(path, bytes).map_err(|error| match error {
                StagingError::Link { path } => {
                    let below = path.strip_prefix(self.staging.content()).unwrap_or(&path);
                    StagingError::Link { path: self.folder.join(below) }
                }
                error => error,
            })?;
        }
        Ok(())
    }

    /// Moves the new content into place.
    ///
    /// # Errors
    /// If it cannot be moved. The old content is unchanged then.
    pub fn commit(self) -> Result<(), StagingError> {
        self.staging.commit()
    }
}
