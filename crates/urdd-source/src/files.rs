//! The files around a description: on the disk, or a set of another source.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;
use urdd_directory::limits::{MAX_SET_BYTES, MAX_SET_FILES};
use urdd_directory::listing::ReadError;
use urdd_directory::regular;
use urdd_directory::root::Root;
use urdd_directory::source::{Memory, OpenFile, Source};

pub use urdd_directory::limits::MAX_URDF_BYTES as MAX_SOURCE_BYTES;

/// Files that say what the folder is that they are in.
const MANIFESTS: [&str; 2] = ["package.xml", "model.config"];

/// Where the files around a description are.
#[derive(Debug, Clone, Default)]
pub enum Files {
    /// On the disk.
    #[default]
    Disk,
    /// In memory, or in another source, by absolute path. There is no other file, and all of them may be read.
    Memory(Arc<Held>),
}

/// Files that are not on the disk, by absolute path.
#[derive(Debug, Clone)]
pub struct Held {
    source: Root,
    /// The path and the size of each in the source.
    files: BTreeMap<PathBuf, (String, u64)>,
    /// Of files whose place may be unknown, by their last names: the paths, and whether it is.
    searched: BTreeMap<OsString, Vec<(PathBuf, bool)>>,
}

impl Held {
    /// The paths of the files.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.files.keys()
    }

    /// Whether there is a file at exactly this path.
    pub fn has(&self, path: &Path) -> bool {
        self.files.contains_key(path)
    }

    fn open(&self, path: &Path, limit: u64) -> Result<(OpenFile, u64), ReadError> {
        let place = self.place(path).ok_or(ReadError::Missing)?;
        match self.files.get(&place).ok_or(ReadError::NotAFile)? {
            (_, size) if *size > limit => Err(ReadError::TooLong { limit }),
            (path, _) => self.source.open(path),
        }
    }

    fn is_dir(&self, folder: &Path) -> bool {
        let mut below = self.files.range(folder.to_owned()..);
        below.find(|(file, _)| **file != folder).is_some_and(|(file, _)| file.starts_with(folder))
    }

    /// Where a path leads: to itself, or to the file of its last name that fits best, if there is but one. Of a path in a
    /// folder that is there, only those fit whose place is unknown.
    fn place(&self, path: &Path) -> Option<PathBuf> {
        let plain = plain(path);
        let is_there = |path: &&PathBuf| self.has(path) || self.is_dir(path);
        if let Some(path) = plain.as_ref().filter(is_there) {
            return Some(path.clone());
        }
        let top = |path: PathBuf| -> PathBuf { path.components().take(2).collect() };
        let is_outside = plain.is_none_or(|path| !self.is_dir(&top(path)));
        let same = |found: &PathBuf| {
            let parts = path.components().rev().zip(found.components().rev());
            parts.take_while(|(asked, found)| asked == found).count()
        };
        let named = self.searched.get(path.file_name()?)?.iter();
        let named = named.filter(|(_, is_lost)| is_outside || *is_lost);
        let mut fits: Vec<_> = named.map(|(found, _)| (same(found), found)).collect();
        fits.sort();
        match fits.as_slice() {
            [.., (second, _), (first, _)] if second == first => None,
            [.., (_, best)] => Some((*best).clone()),
            [] => None,
        }
    }
}

/// Why files cannot be a set in memory.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum MemoryFault {
    #[error("`{0}` is not the relative path of a file")]
    Path(String),
    #[error("there are more than {MAX_SET_FILES} files")]
    TooMany,
    #[error("the files are larger than {} MiB together", MAX_SET_BYTES >> 20)]
    TooLarge,
}

impl Files {
    /// A set in memory, by relative path with forward slashes. Their common folder is `/`.
    ///
    /// # Errors
    /// If a path leads out of the set, or there is too much.
    pub fn in_memory(
        files: impl IntoIterator<Item = (String, Arc<[u8]>)>,
    ) -> Result<Files, MemoryFault> {
        let memory = Memory::default();
        let put = |(path, bytes): (String, Arc<[u8]>)| {
            let size = bytes.len() as u64;
            memory.put(&path, bytes);
            (path, size)
        };
        Files::of(memory.clone(), "", files.into_iter().map(put))
    }

    /// Files of a source that is not the disk, by their paths and sizes there. Their common folder is the one of this name
    /// in `/`, or `/` itself. A file is opened when it is read.
    ///
    /// # Errors
    /// As for [`Files::in_memory`].
    pub fn of(
        source: impl Source + 'static,
        folder: &str,
        files: impl IntoIterator<Item = (String, u64)>,
    ) -> Result<Files, MemoryFault> {
        let (mut all, mut bytes) = (BTreeMap::new(), 0_u64);
        for (path, size) in files {
            let place = plain(&Path::new(folder).join(path.trim_start_matches('/')));
            let Some(place) = place.filter(|place| place.parent().is_some()) else {
                return Err(MemoryFault::Path(path));
            };
            bytes = bytes.saturating_add(size);
            all.insert(place, (path, size));
            if all.len() > MAX_SET_FILES {
                return Err(MemoryFault::TooMany);
            }
            if bytes > MAX_SET_BYTES {
                return Err(MemoryFault::TooLarge);
            }
        }
        let held = Held { source: Root::of(source), files: all, searched: BTreeMap::new() };
        Ok(Files::Memory(Arc::new(held)))
    }

    /// The same set in memory, of which files are found by their last names where nothing is at the path that is asked for:
    /// those for which `is_lost` says that nobody knows their place, and all where the path leads out of the set.
    #[must_use]
    pub fn searched(self, is_lost: impl Fn(&Path) -> bool) -> Files {
        let Files::Memory(held) = self else {
            return self;
        };
        let mut held = Arc::unwrap_or_clone(held);
        for path in held.files.keys() {
            let name = path.file_name().unwrap_or_default();
            if !MANIFESTS.iter().any(|manifest| name == *manifest) {
                let named = held.searched.entry(name.to_owned()).or_default();
                named.push((path.clone(), is_lost(path)));
            }
        }
        Files::Memory(Arc::new(held))
    }

    /// Whether these are the same files, and not only equal ones.
    pub(crate) fn is_same(&self, other: &Files) -> bool {
        match (self, other) {
            (Files::Disk, Files::Disk) => true,
            (Files::Memory(one), Files::Memory(other)) => Arc::ptr_eq(one, other),
            (Files::Disk, Files::Memory(_)) | (Files::Memory(_), Files::Disk) => false,
        }
    }

    /// Reads a regular file of at most `limit` bytes.
    ///
    /// # Errors
    /// If there is none, it is no regular file, it cannot be read, or it is longer.
    pub fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        match self {
            Files::Disk => regular::read(path, limit),
            Files::Memory(files) => {
                let (file, size) = files.open(path, limit)?;
                regular::read_sized(file, size, limit)
            }
        }
    }

    /// The beginning of a regular file, at most so many bytes.
    ///
    /// # Errors
    /// If there is none, it is no regular file, or it cannot be read.
    pub(crate) fn head(&self, path: &Path, most: u64) -> Result<Vec<u8>, ReadError> {
        let file = match self {
            Files::Disk => Box::new(regular::open(path)?),
            Files::Memory(files) => files.open(path, u64::MAX)?.0,
        };
        let mut head = Vec::new();
        file.take(most).read_to_end(&mut head)?;
        Ok(head)
    }

    /// The absolute path of a file or folder, with symbolic links resolved.
    ///
    /// # Errors
    /// If there is none.
    pub fn canonicalize(&self, path: &Path) -> io::Result<PathBuf> {
        match self {
            Files::Disk => path.canonicalize(),
            Files::Memory(files) => files.place(path).ok_or_else(|| io::ErrorKind::NotFound.into()),
        }
    }

    /// Whether there is a regular file, links followed.
    pub fn is_file(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.is_file(),
            Files::Memory(files) => files.place(path).is_some_and(|path| files.has(&path)),
        }
    }

    /// Whether there is a folder, links followed.
    pub fn is_dir(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.is_dir(),
            Files::Memory(files) => plain(path).is_some_and(|path| files.is_dir(&path)),
        }
    }

    /// Whether there is something, links followed.
    pub fn exists(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.exists(),
            Files::Memory(files) => {
                plain(path).is_some_and(|path| files.has(&path) || files.is_dir(&path))
            }
        }
    }

    /// Whether a link leads nowhere.
    pub fn is_dangling(&self, path: &Path) -> bool {
        matches!(self, Files::Disk) && path.is_symlink() && !path.exists()
    }

    /// The names in a folder, sorted; none if it cannot be read.
    pub fn names(&self, folder: &Path) -> Vec<OsString> {
        let Files::Memory(files) = self else {
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            let mut names: Vec<OsString> = entries.map(|entry| entry.file_name()).collect();
            names.sort();
            return names;
        };
        let Some(folder) = plain(folder) else {
            return Vec::new();
        };
        let first = |file: &PathBuf| {
            let inside = file.strip_prefix(&folder).ok()?;
            Some(inside.components().next()?.as_os_str().to_owned())
        };
        let names: BTreeSet<OsString> = files.paths().filter_map(first).collect();
        names.into_iter().collect()
    }
}

/// A path seen from the root, without `.` and `..`; `None` if it leads above the root.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::from("/");
    for part in path.components() {
        match part {
            Component::Normal(name) => plain.push(name),
            Component::ParentDir => {
                if !plain.pop() {
                    return None;
                }
            }
            Component::RootDir | Component::CurDir => {}
            Component::Prefix(_) => return None,
        }
    }
    Some(plain)
}

/// Whether a folder contains more than robots: the file system root or a folder directly in it, the user's home folder
/// or a folder that contains it.
pub(crate) fn is_broad(folder: &Path) -> bool {
    let depth = folder.components().count();
    let home = std::env::home_dir().and_then(|home| home.canonicalize().ok());
    depth <= 2 || home.is_some_and(|home| home.starts_with(folder))
}
