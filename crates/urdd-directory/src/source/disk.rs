//! A URDD in a folder on disk, and what tells whether a file or folder in it is what it was.

use std::fs::{self, DirEntry, File, Metadata};
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use crate::layout::ROOT_METADATA;
use crate::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing};
use crate::read_error::ReadError;
use urdd_format::registry::ModuleKind;

/// Whether a folder is the root of a URDD: it contains `urdd.json`, or a module's folder.
pub fn is_urdd(folder: &Path) -> bool {
    folder.join(ROOT_METADATA).is_file()
        || ModuleKind::ALL.iter().any(|kind| folder.join(kind.folder()).is_dir())
}

/// A folder on disk.
#[derive(Debug, Clone)]
pub struct Disk {
    pub(super) path: PathBuf,
    pub(super) canonical: PathBuf,
}

impl Disk {
    /// Opens a folder as a URDD's root.
    ///
    /// # Errors
    /// If it does not exist, is not a folder, or cannot be accessed.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let canonical = fs::canonicalize(path)?;
        if !canonical.is_dir() {
            return Err(ReadError::NotAUrdd);
        }
        Ok(Disk { path: path.to_owned(), canonical })
    }

    /// The URDD in a folder beside this one.
    pub(super) fn beside(&self, folder_name: &str) -> Option<Disk> {
        let parent = self.canonical.parent()?;
        let sibling = Disk::open(&parent.join(folder_name)).ok()?;
        let is_beside = sibling.canonical.parent() == Some(parent);
        (is_beside && is_urdd(&sibling.canonical)).then_some(sibling)
    }

    /// Lists everything below the root, and what tells whether it changes.
    ///
    /// # Errors
    /// If the root itself cannot be listed.
    pub(super) fn walk(&self) -> Result<(Listing, Vec<Seen>), ReadError> {
        let mut listing = Listing::default();
        let mut found = Vec::new();
        fs::read_dir(&self.canonical)?;
        let mut folders = vec![(self.canonical.clone(), String::new(), 0)];
        while let Some((folder, prefix, depth)) = folders.pop() {
            let entries = match fs::read_dir(&folder) {
                Ok(entries) => entries,
                Err(error) => {
                    listing.unreadable.push((prefix, error.into()));
                    continue;
                }
            };
            for entry in entries.flatten() {
                if found.len() >= MAX_FILES {
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
                let (kind, size, seen) = self.kind_of(&entry);
                if kind == EntryKind::Folder {
                    if depth + 1 < MAX_FOLDER_DEPTH {
                        folders.push((entry.path(), path.clone(), depth + 1));
                    } else {
                        listing.cut = true;
                    }
                }
                found.push((Entry { path, kind, size, utf8: name.to_str().is_some() }, seen));
            }
        }
        found.sort_by(|a, b| a.0.path.cmp(&b.0.path));
        listing.unreadable.sort_by(|a, b| a.0.cmp(&b.0));
        let seen;
        (listing.entries, seen) = found.into_iter().unzip();
        Ok((listing, seen))
    }

    fn kind_of(&self, entry: &DirEntry) -> (EntryKind, u64, Seen) {
        let Ok(metadata) = entry.metadata() else {
            return (EntryKind::Other, 0, Seen::Other);
        };
        let itself = Seen::Itself(Stamp::of(&metadata));
        match metadata.file_type() {
            kind if kind.is_dir() => return (EntryKind::Folder, 0, itself),
            kind if kind.is_file() => return (EntryKind::File, metadata.len(), itself),
            kind if kind.is_symlink() => {}
            _ => return (EntryKind::Other, 0, Seen::Other),
        }
        let path = entry.path();
        match fs::canonicalize(&path) {
            Ok(target) => match target.strip_prefix(&self.canonical) {
                Err(_) => (EntryKind::LinkOut, 0, Seen::Other),
                Ok(inside) => {
                    let parts = inside.iter().map(|part| part.to_string_lossy());
                    let leads = Seen::Leads(parts.collect::<Vec<_>>().join("/"));
                    match fs::metadata(&target) {
                        Ok(of) if of.is_file() => (EntryKind::File, of.len(), leads),
                        _ => (EntryKind::Link, 0, leads),
                    }
                }
            },
            // Classify a broken link by its target, as far as possible.
            Err(_) => match fs::read_link(path) {
                Ok(target) if target.is_absolute() && !target.starts_with(&self.canonical) => {
                    (EntryKind::LinkOut, 0, Seen::Other)
                }
                _ => (EntryKind::Link, 0, Seen::Other),
            },
        }
    }
}

/// What tells one state of a file or folder from another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stamp {
    /// Device and inode number, where there are any.
    place: Option<(u64, u64)>,
    size: u64,
    changed: SystemTime,
}

impl Stamp {
    /// The stamp of what this is the metadata of.
    pub fn of(metadata: &Metadata) -> Self {
        #[cfg(unix)]
        let (place, changed) = {
            use std::os::unix::fs::MetadataExt;
            use std::time::Duration;
            let [seconds, nanoseconds] = [metadata.ctime(), metadata.ctime_nsec()];
            let since = Duration::new(seconds.unsigned_abs(), nanoseconds.unsigned_abs() as u32);
            (Some((metadata.dev(), metadata.ino())), UNIX_EPOCH + since)
        };
        #[cfg(not(unix))]
        let (place, changed) = (None, metadata.modified().unwrap_or(UNIX_EPOCH));
        Stamp { place, size: metadata.len(), changed }
    }

    /// Bytes.
    pub(super) fn size(&self) -> u64 {
        self.size
    }

    /// The time of the last change.
    pub(super) fn changed(&self) -> SystemTime {
        self.changed
    }

    pub(super) fn is_of(&self, file: &File) -> bool {
        file.metadata().is_ok_and(|metadata| Stamp::of(&metadata) == *self)
    }
}

/// What an entry of a folder was.
#[derive(Debug, PartialEq)]
pub(super) enum Seen {
    Itself(Stamp),
    /// A link to this path below the root.
    Leads(String),
    Other,
}
