//! A URDD's root folder on disk: what lies in it, and reading from it without ever leaving it.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use super::path::{self, PathFault};

/// Why a file could not be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("there is no such file")]
    Missing,
    /// The path is not one that a URDD may name.
    #[error("{0}")]
    Path(#[from] PathFault),
    /// A symbolic link leads out of the root.
    #[error("a symbolic link leads out of the URDD's root")]
    LeavesRoot,
    /// Not a regular file.
    #[error("it is not a regular file")]
    NotAFile,
    /// Larger than what is read.
    #[error("it is {size} bytes long, and at most {limit} are read")]
    TooLarge {
        /// Its size, bytes.
        size: u64,
        /// The limit, bytes.
        limit: u64,
    },
    /// The operating system refused.
    #[error("it cannot be read: {0}")]
    Io(String),
}

impl ReadError {
    pub(super) fn from_io(error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => ReadError::Missing,
            io::ErrorKind::PermissionDenied => ReadError::Io("permission denied".to_owned()),
            _ => ReadError::Io(error.to_string()),
        }
    }
}

/// What an entry of a folder is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file, or a link to one inside the root.
    File,
    /// A folder.
    Folder,
    /// A symbolic link that leads out of the root.
    LinkOut,
    /// A symbolic link to nothing, or to a folder inside the root (which is not entered).
    Link,
    /// Neither file nor folder.
    Other,
}

/// A file or folder below the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry {
    /// Path relative to the root, with forward slashes; characters that are not UTF-8 replaced.
    pub path: String,
    /// What it is.
    pub kind: EntryKind,
    /// Size in bytes, for files.
    pub size: u64,
    /// Whether the name is UTF-8.
    pub utf8: bool,
}

/// What lies below a root.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Listing {
    /// Every entry, sorted by path.
    pub entries: Vec<Entry>,
    /// Folders that could not be listed, with the reason.
    pub unreadable: Vec<(String, ReadError)>,
    /// Whether the listing stopped at [`MAX_FILES`] entries or [`MAX_FOLDER_DEPTH`] levels.
    pub cut: bool,
}

impl Listing {
    /// The entry at a path.
    pub fn get(&self, path: &str) -> Option<&Entry> {
        self.entries
            .binary_search_by(|entry| entry.path.as_str().cmp(path))
            .ok()
            .map(|place| &self.entries[place])
    }

    /// Whether there is a folder at a path.
    pub fn has_folder(&self, path: &str) -> bool {
        self.get(path)
            .is_some_and(|entry| entry.kind == EntryKind::Folder)
    }

    /// Whether there is a regular file at a path.
    pub fn has_file(&self, path: &str) -> bool {
        self.get(path)
            .is_some_and(|entry| entry.kind == EntryKind::File)
    }

    /// The entries below a folder, at any depth.
    pub fn below<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = &'a Entry> {
        let is_below = move |entry: &&Entry| {
            entry
                .path
                .strip_prefix(folder)
                .is_some_and(|rest| rest.starts_with('/'))
        };
        // In order of path, what is below a folder stands together.
        let prefix = format!("{folder}/");
        let first = self
            .entries
            .partition_point(|entry| entry.path.as_str() < prefix.as_str());
        self.entries.iter().skip(first).take_while(is_below)
    }
}

/// A URDD's root folder.
#[derive(Debug, Clone)]
pub struct Root {
    path: PathBuf,
    canonical: PathBuf,
}

impl Root {
    /// Opens a folder as a URDD's root.
    ///
    /// # Errors
    /// Where it does not exist, is no folder, or cannot be reached.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let canonical = fs::canonicalize(path).map_err(|error| ReadError::from_io(&error))?;
        if !canonical.is_dir() {
            return Err(ReadError::NotAFile);
        }
        Ok(Root {
            path: path.to_owned(),
            canonical,
        })
    }

    /// The folder, as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folder's own name.
    pub fn folder_name(&self) -> String {
        self.canonical
            .file_name()
            .unwrap_or(OsStr::new(""))
            .to_string_lossy()
            .into_owned()
    }

    /// Lists everything below the root; links are not followed.
    ///
    /// # Errors
    /// Where the root itself cannot be listed.
    pub fn list(&self) -> Result<Listing, ReadError> {
        let mut listing = Listing::default();
        fs::read_dir(&self.canonical).map_err(|error| ReadError::from_io(&error))?;
        let mut folders = vec![(self.canonical.clone(), String::new(), 0)];
        while let Some((folder, prefix, depth)) = folders.pop() {
            let entries = match fs::read_dir(&folder) {
                Ok(entries) => entries,
                Err(error) => {
                    listing
                        .unreadable
                        .push((prefix, ReadError::from_io(&error)));
                    continue;
                }
            };
            for entry in entries.flatten() {
                if listing.entries.len() >= MAX_FILES {
                    listing.cut = true;
                    break;
                }
                let name = entry.file_name();
                let shown = name.to_string_lossy();
                let path = if prefix.is_empty() {
                    shown.into_owned()
                } else {
                    format!("{prefix}/{shown}")
                };
                let (kind, size) = self.kind_of(&entry.path());
                if kind == EntryKind::Folder {
                    if depth + 1 < MAX_FOLDER_DEPTH {
                        folders.push((entry.path(), path.clone(), depth + 1));
                    } else {
                        listing.cut = true;
                    }
                }
                listing.entries.push(Entry {
                    path,
                    kind,
                    size,
                    utf8: name.to_str().is_some(),
                });
            }
        }
        listing.entries.sort_by(|a, b| a.path.cmp(&b.path));
        listing.unreadable.sort_by(|a, b| a.0.cmp(&b.0));
        Ok(listing)
    }

    fn kind_of(&self, path: &Path) -> (EntryKind, u64) {
        let Ok(metadata) = fs::symlink_metadata(path) else {
            return (EntryKind::Other, 0);
        };
        if metadata.is_dir() {
            return (EntryKind::Folder, 0);
        }
        if metadata.is_file() {
            return (EntryKind::File, metadata.len());
        }
        if !metadata.file_type().is_symlink() {
            return (EntryKind::Other, 0);
        }
        match fs::canonicalize(path) {
            Ok(target) if !target.starts_with(&self.canonical) => (EntryKind::LinkOut, 0),
            Ok(target) => match fs::metadata(target) {
                Ok(metadata) if metadata.is_file() => (EntryKind::File, metadata.len()),
                _ => (EntryKind::Link, 0),
            },
            // A broken link is judged by where it points, as far as that can be told.
            Err(_) => match fs::read_link(path) {
                Ok(target) if target.is_absolute() && !target.starts_with(&self.canonical) => {
                    (EntryKind::LinkOut, 0)
                }
                _ => (EntryKind::Link, 0),
            },
        }
    }

    /// Reads a file of at most `limit` bytes.
    ///
    /// # Errors
    /// Where the path is not one that a URDD may name, leads out of the root, or cannot be read.
    pub fn read(&self, relative: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
        let (mut file, size) = self.open_file(relative)?;
        if size > limit {
            return Err(ReadError::TooLarge { size, limit });
        }
        let mut bytes = Vec::with_capacity(size as usize);
        // The file may grow while it is read: the limit holds all the same.
        file.by_ref()
            .take(limit + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| ReadError::from_io(&error))?;
        if bytes.len() as u64 > limit {
            return Err(ReadError::TooLarge {
                size: bytes.len() as u64,
                limit,
            });
        }
        Ok(bytes)
    }

    /// Opens a file for reading, and tells its size.
    ///
    /// # Errors
    /// As for [`Root::read`].
    pub fn open_file(&self, relative: &str) -> Result<(fs::File, u64), ReadError> {
        path::check(relative)?;
        let target = fs::canonicalize(self.canonical.join(relative))
            .map_err(|error| ReadError::from_io(&error))?;
        if !target.starts_with(&self.canonical) {
            return Err(ReadError::LeavesRoot);
        }
        // Looked at before it is opened: opening a pipe would wait for ever.
        let metadata = fs::metadata(&target).map_err(|error| ReadError::from_io(&error))?;
        if !metadata.is_file() {
            return Err(ReadError::NotAFile);
        }
        let file = fs::File::open(&target).map_err(|error| ReadError::from_io(&error))?;
        Ok((file, metadata.len()))
    }

    /// A URDD beside this one, in the same parent folder: legacy mesh paths may lead there.
    pub fn sibling(&self, folder_name: &str) -> Option<Root> {
        path::check(folder_name).ok()?;
        if folder_name.contains('/') {
            return None;
        }
        let parent = self.canonical.parent()?;
        let sibling = Root::open(&parent.join(folder_name)).ok()?;
        (sibling.canonical.parent() == Some(parent) && super::discover::is_urdd(&sibling.canonical))
            .then_some(sibling)
    }
}
