//! A URDD in memory that is being written.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::memory::Memory;
use super::{OpenFile, Source};
use crate::listing::Listing;
use crate::read_error::ReadError;

/// A URDD in memory to which files are added. Copies share the files.
#[derive(Debug, Clone, Default)]
pub struct Growing(Arc<Mutex<Files>>);

/// The bytes of each file, by path relative to the root, with forward slashes.
type Files = BTreeMap<String, Arc<[u8]>>;

impl Growing {
    /// Adds a file, or replaces it.
    pub(crate) fn add(&self, path: &str, bytes: Vec<u8>) {
        self.now().insert(path.to_owned(), bytes.into());
    }

    /// The files so far.
    pub fn files(&self) -> BTreeMap<String, Arc<[u8]>> {
        self.now().clone()
    }

    fn now(&self) -> MutexGuard<'_, Files> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Source for Growing {
    fn folder_name(&self) -> String {
        String::new()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let memory = Memory::new("", self.files()).map_err(|(_, fault)| ReadError::from(fault))?;
        memory.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let file = self.now().get(path).cloned().ok_or(ReadError::Missing)?;
        let size = file.len() as u64;
        Ok((Box::new(Cursor::new(file)), size))
    }
}
