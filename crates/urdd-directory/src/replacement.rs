//! Some files of a URDD replaced by others, in one step: all of them, or none.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::staging::{Staging, StagingError};
use super::take::take_content;
use super::writer::Writer;
use crate::cancellation::Cancellation;

/// Files by path, relative to the root of their URDD.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A folder of which files are to be replaced. From [`Replacement::begin`] on no other run of this program writes there.
#[derive(Debug)]
pub struct Replacement {
    folder: PathBuf,
    staging: Staging,
}

impl Replacement {
    /// Waits until nobody else writes there.
    ///
    /// # Errors
    /// Where the folder cannot be written beside.
    pub fn begin(folder: &Path) -> Result<Self, StagingError> {
        Ok(Replacement {
            folder: folder.to_owned(),
            staging: Staging::begin_inside(folder, &Cancellation::default())?,
        })
    }

    /// Makes the new content, with these files instead of those of their names; all others stay.
    ///
    /// # Errors
    /// Where something cannot be read or written.
    pub fn stage(&self, files: &Files) -> Result<(), StagingError> {
        let writer = Writer::new(self.staging.content());
        let instead: BTreeSet<&Path> = files.keys().map(Path::new).collect();
        take_content(&self.folder, self.staging.content(), &|path| {
            instead.contains(path)
        })?;
        for (path, bytes) in files {
            writer.file(path, bytes)?;
        }
        Ok(())
    }

    /// Puts the new content in its place.
    ///
    /// # Errors
    /// Where it cannot be; what was there before still is.
    pub fn commit(self) -> Result<(), StagingError> {
        self.staging.commit()
    }
}
