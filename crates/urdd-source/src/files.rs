//! The files around a description: on the disk, or a set in memory.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use thiserror::Error;

use urdd_directory::read_error::ReadError;
use urdd_directory::regular;

/// Maximum size of a URDF in bytes. The validator has the same limit.
pub const MAX_SOURCE_BYTES: u64 = 64 << 20;
/// Maximum number of files in memory.
const MOST_FILES: usize = 20_000;
/// Maximum size of all files in memory, bytes.
const MOST_BYTES: usize = 2 << 30;

/// Where the files around a description are.
#[derive(Debug, Clone, Default)]
pub enum Files {
    /// On the disk.
    #[default]
    Disk,
    /// In memory, by absolute path. There is no other file, and all of them may be read.
    Memory(Arc<BTreeMap<PathBuf, Arc<[u8]>>>),
}

/// Why files cannot be a set in memory.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum MemoryFault {
    #[error("`{0}` is not the relative path of a file")]
    Path(String),
    #[error("there are more than {MOST_FILES} files")]
    TooMany,
    #[error("the files are larger than {} MiB together", MOST_BYTES >> 20)]
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
        let (mut all, mut bytes) = (BTreeMap::new(), 0_usize);
        for (path, content) in files {
            let plain = plain(Path::new(&path)).filter(|path| path.parent().is_some());
            let Some(plain) = plain else {
                return Err(MemoryFault::Path(path));
            };
            bytes = bytes.saturating_add(content.len());
            all.insert(plain, content);
            if all.len() > MOST_FILES {
                return Err(MemoryFault::TooMany);
            }
            if bytes > MOST_BYTES {
                return Err(MemoryFault::TooLarge);
            }
        }
        Ok(Files::Memory(Arc::new(all)))
    }

    /// Reads a regular file of at most `limit` bytes.
    ///
    /// # Errors
    /// If there is none, it is no regular file, it cannot be read, or it is longer.
    pub fn read(&self, path: &Path, limit: u64) -> Result<Vec<u8>, ReadError> {
        let Files::Memory(files) = self else {
            return regular::read(path, limit);
        };
        let path = self.canonicalize(path).map_err(|_| ReadError::Missing)?;
        match files.get(&path) {
            Some(bytes) if bytes.len() as u64 > limit => Err(ReadError::TooLong { limit }),
            Some(bytes) => Ok(bytes.to_vec()),
            None => Err(ReadError::NotAFile),
        }
    }

    /// The beginning of a regular file, at most so many bytes.
    ///
    /// # Errors
    /// If there is none, it is no regular file, or it cannot be read.
    pub(crate) fn head(&self, path: &Path, most: u64) -> Result<Vec<u8>, ReadError> {
        let Files::Disk = self else {
            let mut bytes = self.read(path, u64::MAX)?;
            bytes.truncate(usize::try_from(most).unwrap_or(usize::MAX));
            return Ok(bytes);
        };
        let mut head = Vec::new();
        regular::open(path)?.take(most).read_to_end(&mut head)?;
        Ok(head)
    }

    /// The absolute path of a file or folder, with symbolic links resolved.
    ///
    /// # Errors
    /// If there is none.
    pub fn canonicalize(&self, path: &Path) -> io::Result<PathBuf> {
        if matches!(self, Files::Disk) {
            return path.canonicalize();
        }
        let plain = plain(path);
        plain.filter(|path| self.exists(path)).ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    /// Whether there is a regular file, links followed.
    pub fn is_file(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.is_file(),
            Files::Memory(files) => plain(path).is_some_and(|path| files.contains_key(&path)),
        }
    }

    /// Whether there is a folder, links followed.
    pub fn is_dir(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.is_dir(),
            Files::Memory(files) => plain(path).is_some_and(|path| {
                let mut below = files.range(path.clone()..);
                below
                    .find(|(file, _)| **file != path)
                    .is_some_and(|(file, _)| file.starts_with(&path))
            }),
        }
    }

    /// Whether there is something, links followed.
    pub fn exists(&self, path: &Path) -> bool {
        match self {
            Files::Disk => path.exists(),
            Files::Memory(_) => self.is_file(path) || self.is_dir(path),
        }
    }

    /// Whether a link leads nowhere.
    pub fn is_dangling(&self, path: &Path) -> bool {
        matches!(self, Files::Disk) && path.is_symlink() && !path.exists()
    }

    /// The names in a folder, in no order; none if it cannot be read.
    pub fn names(&self, folder: &Path) -> Vec<OsString> {
        let Files::Memory(files) = self else {
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            return entries.map(|entry| entry.file_name()).collect();
        };
        let Some(folder) = plain(folder) else {
            return Vec::new();
        };
        let first = |file: &PathBuf| {
            let inside = file.strip_prefix(&folder).ok()?;
            Some(inside.components().next()?.as_os_str().to_owned())
        };
        let names: BTreeSet<OsString> = files.keys().filter_map(first).collect();
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
