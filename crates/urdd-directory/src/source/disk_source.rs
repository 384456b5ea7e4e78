//! A folder on disk as storage: as it is at each question, or as it is now ([`Source::kept`]).

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::sync::Arc;

use super::disk::Disk;
use super::snapshot::Snapshot;
use super::{OpenFile, Source};
use crate::listing::Listing;
use crate::read_error::ReadError;
use crate::regular;

impl Source for Disk {
    fn folder_name(&self) -> String {
        let name = self.canonical.file_name().unwrap_or(OsStr::new(""));
        name.to_string_lossy().into_owned()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        Ok(self.walk()?.0)
    }

    fn open(&self, relative: &str) -> Result<(OpenFile, u64), ReadError> {
        let target = fs::canonicalize(self.canonical.join(relative))?;
        if !target.starts_with(&self.canonical) {
            return Err(ReadError::LeavesRoot);
        }
        let file = regular::open(&target)?;
        let size = file.metadata()?.len();
        Ok((Box::new(file), size))
    }

    fn sibling(&self, folder_name: &str) -> Option<Arc<dyn Source>> {
        Some(Arc::new(self.beside(folder_name)?))
    }

    fn kept(&self) -> Option<Arc<dyn Source>> {
        Some(Arc::new(Snapshot::of(self.clone())))
    }

    fn folder(&self) -> Option<&Path> {
        Some(&self.path)
    }
}
