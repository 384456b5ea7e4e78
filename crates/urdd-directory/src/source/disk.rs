//! A URDD in a folder on disk.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{OpenFile, Source};
use crate::layout::ROOT_METADATA;
use crate::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing};
use crate::read_error::ReadError;
use crate::regular;
use urdd_format::registry::ModuleKind;

/// Whether a folder is the root of a URDD: it contains `urdd.json`, or a module's folder.
pub fn is_urdd(folder: &Path) -> bool {
    folder.join(ROOT_METADATA).is_file()
        || ModuleKind::ALL.iter().any(|kind| folder.join(kind.folder()).is_dir())
}

/// A folder on disk.
#[derive(Debug, Clone)]
pub struct Disk {
    path: PathBuf,
    canonical: PathBuf,
}

impl Disk {
    /// Opens a folder as a URDD's root.
    ///
    /// # Errors
    /// If it does not exist, is not a folder, or cannot be accessed.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let canonical = fs::canonicalize(path).map_err(|error| ReadError::from_io(&error))?;
        if !canonical.is_dir() {
            return Err(ReadError::NotAUrdd);
        }
        Ok(Disk { path: path.to_owned(), canonical })
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
            // Classify a broken link by its target, as far as possible.
            Err(_) => match fs::read_link(path) {
                Ok(target) if target.is_absolute() && !target.starts_with(&self.canonical) => {
                    (EntryKind::LinkOut, 0)
                }
                _ => (EntryKind::Link, 0),
            },
        }
    }
}

impl Source for Disk {
    fn folder_name(&self) -> String {
        let name = self.canonical.file_name().unwrap_or(OsStr::new(""));
        name.to_string_lossy().into_owned()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let mut listing = Listing::default();
        fs::read_dir(&self.canonical).map_err(|error| ReadError::from_io(&error))?;
        let mut folders = vec![(self.canonical.clone(), String::new(), 0)];
        while let Some((folder, prefix, depth)) = folders.pop() {
            let entries = match fs::read_dir(&folder) {
                Ok(entries) => entries,
                Err(error) => {
                    listing.unreadable.push((prefix, ReadError::from_io(&error)));
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
                listing.entries.push(Entry { path, kind, size, utf8: name.to_str().is_some() });
            }
        }
        listing.entries.sort_by(|a, b| a.path.cmp(&b.path));
        listing.unreadable.sort_by(|a, b| a.0.cmp(&b.0));
        Ok(listing)
    }

    fn open(&self, relative: &str) -> Result<(OpenFile, u64), ReadError> {
        let target = fs::canonicalize(self.canonical.join(relative))
            .map_err(|error| ReadError::from_io(&error))?;
        if !target.starts_with(&self.canonical) {
            return Err(ReadError::LeavesRoot);
        }
        let file = regular::open(&target)?;
        let metadata = file.metadata();
        let size = metadata.map_err(|error| ReadError::from_io(&error))?.len();
        Ok((Box::new(file), size))
    }

    fn sibling(&self, folder_name: &str) -> Option<Arc<dyn Source>> {
        let parent = self.canonical.parent()?;
        let sibling = Disk::open(&parent.join(folder_name)).ok()?;
        let is_beside = sibling.canonical.parent() == Some(parent);
        (is_beside && is_urdd(&sibling.canonical)).then(|| Arc::new(sibling) as _)
    }

    fn folder(&self) -> Option<&Path> {
        Some(&self.path)
    }
}
