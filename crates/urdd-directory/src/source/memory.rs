//! A URDD in memory: complete, or being written.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::tree::{Item, Node, Tree};
use super::{OpenFile, Source};
use crate::listing::Listing;
use crate::path::{self, PathFault};
use crate::read_error::ReadError;

/// The bytes of each file, by path relative to the root, with forward slashes.
type Files = BTreeMap<String, Arc<[u8]>>;

/// A URDD in memory: a name and the bytes of each file.
#[derive(Debug)]
pub struct Memory {
    name: String,
    tree: Tree<Arc<[u8]>>,
}

impl Memory {
    /// A URDD from files by path. `name` names the root folder.
    ///
    /// # Errors
    /// The first path that SPEC 2.8 forbids, or that is both a file and a folder.
    pub fn new(name: &str, files: Files) -> Result<Self, (String, PathFault)> {
        let item = |(path, data): (String, Arc<[u8]>)| {
            path::check(&path).map_err(|fault| (path.clone(), fault))?;
            let size = data.len() as u64;
            Ok(Item { path, utf8: true, node: Node::File { size, data } })
        };
        let items = files.into_iter().map(item).collect::<Result<_, _>>()?;
        let tree = Tree::new(items).map_err(|path| (path, PathFault::Taken))?;
        Ok(Memory { name: name.to_owned(), tree })
    }
}

impl Source for Memory {
    fn folder_name(&self) -> String {
        self.name.clone()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        Ok(self.tree.listing())
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let (data, size) = self.tree.file(path)?;
        Ok((Box::new(Cursor::new(Arc::clone(data))), size))
    }
}

/// A URDD in memory to which files are added. Copies share the files.
#[derive(Debug, Clone, Default)]
pub struct Growing(Arc<Mutex<Files>>);

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
        Memory::new("", self.files()).map_err(|(_, fault)| ReadError::from(fault))?.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let file = self.now().get(path).cloned().ok_or(ReadError::Missing)?;
        let size = file.len() as u64;
        Ok((Box::new(Cursor::new(file)), size))
    }
}
