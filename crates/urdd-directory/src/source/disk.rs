//! A folder on disk as storage: as it is at each question, or as it was when it was opened. A later read of the latter
//! gives what was there then, or [`ReadError::Changed`].
//!
//! Opening lists the folder, and takes a stamp of each file: device, inode number, size, and the time of the last status
//! change (ctime) in nanoseconds. No content is read. Reading compares the stamp of the open file after its last byte, so
//! a change during the read is noticed too. No program can set a ctime: a change that keeps size and mtime is noticed,
//! and another folder in this place has other inode numbers. Links lead where they led when the folder was opened.
//!
//! Two changes within one tick of the system's clock have the same ctime. So where something changed less than [`TICK`]
//! before the list or during it, the folder is listed again after that time, until two lists in a row are equal; if none
//! are, each read is [`ReadError::Changed`]. The URDDs beside one without `urdd.json`, where its meshes may be, are listed too.
//!
//! A new hard link to a file and new permissions count as a change. A change that keeps the size can be missed where
//! times are coarser than [`TICK`] (FAT: 2 s), where the client of a file server keeps them for a while (NFS: 3 s), and
//! on Windows, which has no ctime, if the mtime is reset.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::fs::{self, DirEntry, File, Metadata};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::{OpenFile, Source};
use crate::file_type::ROOT_METADATA;
use crate::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing, ReadError};
use crate::regular;
use urdd_format::registry::ModuleKind;

/// Whether a folder is the root of a URDD: it contains `urdd.json`, or a module's folder.
pub fn is_urdd(folder: &Path) -> bool {
    let metadata = folder.join(ROOT_METADATA);
    let is_inside = || {
        let places = metadata.canonicalize().ok().zip(folder.canonicalize().ok());
        places.is_some_and(|(file, folder)| file.starts_with(folder))
    };
    metadata.is_file() && (!metadata.is_symlink() || is_inside())
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
        let canonical = fs::canonicalize(path)?;
        if !canonical.is_dir() {
            return Err(ReadError::NotAUrdd);
        }
        Ok(Disk { path: path.to_owned(), canonical })
    }

    /// The URDD in a folder beside this one.
    fn beside(&self, folder_name: &str) -> Option<Disk> {
        let parent = self.canonical.parent()?;
        let sibling = Disk::open(&parent.join(folder_name)).ok()?;
        let is_beside = sibling.canonical.parent() == Some(parent);
        (is_beside && is_urdd(&sibling.canonical)).then_some(sibling)
    }

    /// Lists everything below the root, and what tells whether it changes.
    ///
    /// # Errors
    /// If the root itself cannot be listed.
    fn walk(&self) -> Result<(Listing, Vec<Seen>), ReadError> {
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

    /// Whether this is still the metadata of it.
    fn is_of(&self, metadata: io::Result<Metadata>) -> bool {
        metadata.is_ok_and(|metadata| Stamp::of(&metadata) == *self)
    }
}

/// What an entry of a folder was.
#[derive(Debug, PartialEq)]
enum Seen {
    Itself(Stamp),
    /// A link to this path below the root.
    Leads(String),
    Other,
}

/// Twice the longest tick of Linux (10 ms).
const TICK: Duration = Duration::from_millis(20);
/// Most lists of a folder that keeps changing.
const MAX_LISTS: usize = 20;

/// The entries of a folder, and what each was.
#[derive(Debug, PartialEq)]
struct Look {
    root: Stamp,
    listing: Listing,
    seen: Vec<Seen>,
}

impl Look {
    fn at_root(disk: &Disk) -> Result<Self, ReadError> {
        let root = fs::metadata(&disk.canonical)?;
        let (listing, seen) = disk.walk()?;
        Ok(Look { root: Stamp::of(&root), listing, seen })
    }

    /// A look at a folder that does not change meanwhile.
    fn settled(disk: &Disk) -> Result<Self, ReadError> {
        let begun = SystemTime::now();
        let mut look = Self::at_root(disk)?;
        if look.is_settled(disk, begun) {
            return Ok(look);
        }
        for _ in 0..MAX_LISTS {
            thread::sleep(TICK);
            let again = Self::at_root(disk)?;
            if again == look {
                return Ok(again);
            }
            look = again;
        }
        Err(ReadError::Changed)
    }

    /// Whether nothing in it is new, and all of its folders are still those that were listed.
    fn is_settled(&self, disk: &Disk, begun: SystemTime) -> bool {
        let is_old = |stamp: &Stamp| stamp.changed + TICK < begun;
        let is_kept = |(entry, seen): (&Entry, &Seen)| match (entry.kind, seen) {
            (EntryKind::Folder, Seen::Itself(stamp)) => {
                is_old(stamp) && stamp.is_of(fs::metadata(disk.canonical.join(&entry.path)))
            }
            (_, Seen::Itself(stamp)) => is_old(stamp),
            (_, Seen::Leads(_) | Seen::Other) => true,
        };
        self.listing.entries.iter().zip(&self.seen).all(is_kept)
            && self.root.is_of(fs::metadata(&disk.canonical))
    }

    fn at(&self, path: &str) -> Option<&Seen> {
        self.seen.get(self.listing.place(path)?)
    }

    /// A path without links, and the stamp of what is there.
    fn follow(&self, path: &str) -> Option<(String, Stamp)> {
        let mut at = String::new();
        for part in path.split('/') {
            if !at.is_empty() {
                at.push('/');
            }
            at.push_str(part);
            if let Some(Seen::Leads(target)) = self.at(&at) {
                at.clone_from(target);
            }
        }
        match self.at(&at)? {
            Seen::Itself(stamp) => Some((at, *stamp)),
            Seen::Leads(_) | Seen::Other => None,
        }
    }
}

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

/// A folder on disk as it was when it was opened.
#[derive(Debug)]
struct Snapshot {
    disk: Disk,
    look: Result<Look, ReadError>,
    /// The URDDs beside one without `urdd.json`, by the names of their folders.
    beside: HashMap<String, Arc<Snapshot>>,
}

impl Snapshot {
    /// The folder as it is now.
    pub fn of(disk: Disk) -> Self {
        let look = Look::settled(&disk);
        let is_legacy = look.as_ref().is_ok_and(|look| !look.listing.has_file(ROOT_METADATA));
        let parent = disk.canonical.parent().filter(|_| is_legacy);
        let entries = parent.and_then(|parent| fs::read_dir(parent).ok()).into_iter().flatten();
        let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
        let of = |name: String| {
            let disk = disk.beside(&name)?;
            let look = Look::settled(&disk);
            Some((name, Arc::new(Snapshot { disk, look, beside: HashMap::new() })))
        };
        let names = names.filter(|name| *name != disk.folder_name());
        Snapshot { beside: names.filter_map(of).collect(), look, disk }
    }
}

impl Source for Snapshot {
    fn folder_name(&self) -> String {
        self.disk.folder_name()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        self.look.as_ref().map(|look| look.listing.clone()).map_err(Clone::clone)
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        let look = self.look.as_ref().map_err(Clone::clone)?;
        let Some((path, stamp)) = look.follow(path) else {
            // A file that is there now was not there before.
            return Err(self.disk.open(path).err().unwrap_or(ReadError::Missing));
        };
        let path = self.disk.canonical.join(path);
        match regular::open(&path) {
            Ok(file) if stamp.is_of(file.metadata()) => {
                let left = stamp.size;
                Ok((Box::new(Unchanged { file, stamp, left }), stamp.size))
            }
            Err(error) if stamp.is_of(fs::metadata(&path)) => Err(error),
            _ => Err(ReadError::Changed),
        }
    }

    fn sibling(&self, folder_name: &str) -> Option<Arc<dyn Source>> {
        Some(Arc::clone(self.beside.get(folder_name)?) as _)
    }

    fn folder(&self) -> Option<&Path> {
        self.disk.folder()
    }
}

/// A file that must still have its stamp when its last byte was read.
struct Unchanged {
    file: File,
    stamp: Stamp,
    left: u64,
}

impl Read for Unchanged {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(buffer)?;
        self.left = self.left.saturating_sub(read as u64);
        let is_end = read == 0 || self.left == 0;
        match is_end && !self.stamp.is_of(self.file.metadata()) {
            true => Err(io::Error::other(ReadError::Changed)),
            false => Ok(read),
        }
    }
}
