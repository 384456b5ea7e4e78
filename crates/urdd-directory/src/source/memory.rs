//! Files in memory: those of a URDD or of a description, complete or while they are added.

use std::collections::BTreeMap;
use std::io::{self, Cursor};
use std::ops::Bound;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::tree::{Item, Node, Tree};
use super::{OpenFile, Source};
use crate::listing::Listing;
use crate::path::{self, PathFault};
use crate::read_error::ReadError;

/// Gives the bytes of a file that is in memory by its size alone; `None` if they are not there yet.
pub type Lend = fn(&str) -> io::Result<Option<Arc<[u8]>>>;

/// The size and the bytes of each file, by path relative to the root, with forward slashes.
type Files = BTreeMap<String, (u64, Option<Arc<[u8]>>)>;

/// Files in memory, to which others may be added. Copies share them.
#[derive(Debug, Clone)]
pub struct Memory {
    name: String,
    files: Arc<Mutex<Files>>,
    lend: Lend,
}

impl Default for Memory {
    fn default() -> Self {
        Memory::empty("", |_| Ok(None))
    }
}

impl Memory {
    /// A URDD from files by path. `name` names the root folder.
    ///
    /// # Errors
    /// The first path that SPEC 2.8 forbids, or that is both a file and a folder.
    pub fn new(
        name: &str,
        files: BTreeMap<String, Arc<[u8]>>,
    ) -> Result<Self, (String, PathFault)> {
        let mut all = Files::new();
        for (path, bytes) in files {
            path::check(&path).map_err(|fault| (path.clone(), fault))?;
            all.insert(path, (bytes.len() as u64, Some(bytes)));
        }
        if let Some(path) = all.keys().find_map(|path| first_below(&all, path)) {
            return Err((path.clone(), PathFault::Taken));
        }
        let memory = Memory::empty(name, |_| Ok(None));
        *memory.now() = all;
        Ok(memory)
    }

    /// A root folder of this name without files. `lend` gives the bytes of those that are only named.
    pub fn empty(name: &str, lend: Lend) -> Self {
        Memory { name: name.to_owned(), files: Arc::default(), lend }
    }

    /// Adds a file by its size. One that is there stays.
    pub fn name(&self, path: &str, size: u64) {
        self.now().entry(path.to_owned()).or_insert((size, None));
    }

    /// Adds the bytes of a file. One that has bytes keeps them; one of another size than was named cannot be read.
    pub fn give(&self, path: &str, bytes: &[u8]) {
        let mut files = self.now();
        let (_, content) = files.entry(path.to_owned()).or_insert((bytes.len() as u64, None));
        content.get_or_insert_with(|| bytes.into());
    }

    /// Adds a file, or replaces it.
    pub fn put(&self, path: &str, bytes: impl Into<Arc<[u8]>>) {
        let bytes = bytes.into();
        self.now().insert(path.to_owned(), (bytes.len() as u64, Some(bytes)));
    }

    /// The files with bytes so far.
    pub fn files(&self) -> BTreeMap<String, Arc<[u8]>> {
        let files = self.now();
        let with_bytes =
            files.iter().filter_map(|(path, (_, bytes))| Some((path, bytes.as_ref()?)));
        with_bytes.map(|(path, bytes)| (path.clone(), Arc::clone(bytes))).collect()
    }

    fn now(&self) -> MutexGuard<'_, Files> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Source for Memory {
    fn folder_name(&self) -> String {
        self.name.clone()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let files = self.now();
        // A name that is a folder too is listed as that.
        let all = files.iter().filter(|(path, _)| first_below(&files, path).is_none());
        let item = |(path, (size, _)): (&String, &(u64, _))| Item {
            path: path.clone(),
            utf8: true,
            node: Node::File { size: *size, data: () },
        };
        Ok(Tree::new(all.map(item).collect()).map_err(|_| PathFault::Taken)?.listing())
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let found = self.now().get(path).cloned();
        let Some((size, bytes)) = found else {
            return Err(match first_below(&self.now(), path) {
                Some(_) => ReadError::NotAFile,
                None => ReadError::Missing,
            });
        };
        // Nothing is locked while somebody else is asked.
        let bytes = bytes.map_or_else(|| (self.lend)(path), |bytes| Ok(Some(bytes)))?;
        match bytes {
            Some(bytes) if bytes.len() as u64 == size => Ok((Box::new(Cursor::new(bytes)), size)),
            Some(_) => Err(ReadError::Changed),
            None => Err(ReadError::Io("its bytes are not there yet".to_owned())),
        }
    }
}

/// The first file in a folder, at any depth.
fn first_below<'a>(files: &'a Files, folder: &str) -> Option<&'a String> {
    let below = format!("{folder}/");
    let mut after = files.range::<str, _>((Bound::Excluded(&*below), Bound::Unbounded));
    after.next().map(|(file, _)| file).filter(|file| file.starts_with(&below))
}
