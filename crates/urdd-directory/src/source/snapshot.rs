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
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, SystemTime};

use super::disk::{Disk, Seen, Stamp};
use super::{OpenFile, Source};
use crate::layout::ROOT_METADATA;
use crate::listing::{Entry, EntryKind, Listing};
use crate::read_error::ReadError;
use crate::regular;

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
        let is_old = |stamp: &Stamp| stamp.changed() + TICK < begun;
        let is_same = |folder: &Path, stamp: &Stamp| {
            fs::metadata(folder).is_ok_and(|now| Stamp::of(&now) == *stamp)
        };
        let is_kept = |(entry, seen): (&Entry, &Seen)| match (entry.kind, seen) {
            (EntryKind::Folder, Seen::Itself(stamp)) => {
                is_old(stamp) && is_same(&disk.canonical.join(&entry.path), stamp)
            }
            (_, Seen::Itself(stamp)) => is_old(stamp),
            (_, Seen::Leads(_) | Seen::Other) => true,
        };
        self.listing.entries.iter().zip(&self.seen).all(is_kept)
            && is_same(&disk.canonical, &self.root)
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
pub(super) struct Snapshot {
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
        let is_same = || fs::metadata(&path).is_ok_and(|now| Stamp::of(&now) == stamp);
        match regular::open(&path) {
            Ok(file) if stamp.is_of(&file) => {
                let left = stamp.size();
                Ok((Box::new(Unchanged { file, stamp, left }), stamp.size()))
            }
            Err(error) if is_same() => Err(error),
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
        match is_end && !self.stamp.is_of(&self.file) {
            true => Err(io::Error::other(ReadError::Changed)),
            false => Ok(read),
        }
    }
}
