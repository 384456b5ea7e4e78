//! The displayed robots.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::revision;
use urdd_directory::carried::carried;
use urdd_directory::discover::{DiscoverError, ROOT_METADATA, discover};
use urdd_directory::replacement::Files;
use urdd_directory::root::{ReadError, Root};

/// A displayed robot.
#[derive(Debug)]
pub struct Shown {
    /// Its unique identifier in URLs: ASCII letters, digits, `-`, `_` and `.`.
    pub id: String,
    /// Its displayed name: its path from the given folder.
    pub name: String,
    standing: Mutex<Standing>,
    /// The files, and their revision.
    opened: Mutex<Option<(String, Opened)>>,
    /// Whether a page has received the failure of its generation.
    failure_told: AtomicBool,
    /// The report, and its revision.
    pub(super) report: Mutex<Option<(String, String)>>,
    /// The picture, and its revision.
    pub(super) picture: Mutex<Option<(String, Option<Vec<u8>>)>>,
    /// The saves that can be undone: the revision after each, and the files before it.
    pub(super) undo: Mutex<Vec<(String, Files)>>,
}

/// The mutable state of a displayed robot.
#[derive(Debug)]
struct Standing {
    path: PathBuf,
    notes: Vec<String>,
    kind: Kind,
    making: Making,
}

/// The operations allowed on a robot's files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// An archive or a URDD from before version 1: read-only.
    ReadOnly,
    /// A version 1 folder: skips can be saved.
    Writable,
    /// Generated for display: the whole URDD can be saved into a folder.
    Temporary,
}

/// Progress of a robot's generation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Making {
    /// Generation is complete, or was not needed.
    Done,
    /// A module is being generated.
    Running {
        /// The module.
        what: String,
        /// Number of finished modules.
        done: usize,
        /// Total number of modules.
        of: usize,
    },
    /// Generation failed, with the reason.
    Failed(String),
}

/// The files of a displayed robot. All requests share one archive in memory.
#[derive(Debug, Clone)]
pub struct Opened {
    /// All files: for the validator.
    pub all: Root,
    /// The URDD's own files (see [`carried`]): for everything else.
    pub own: Root,
}

impl Shown {
    /// The current files, and their revision.
    ///
    /// # Errors
    /// If they no longer exist or cannot be read.
    pub fn open(&self) -> Result<(String, Opened), ReadError> {
        let path = self.path();
        // Taken before the files are listed, so that later changes are detected.
        let revision = revision::of(&path);
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of, known)) = opened.as_ref()
            && *of == revision
        {
            return Ok((revision, known.clone()));
        }
        // Drops the old archive first: only one is in memory.
        *opened = None;
        let all = Root::open(&path)?;
        let own = carried(&all)?;
        let found = Opened { all, own };
        *opened = Some((revision.clone(), found.clone()));
        Ok((revision, found))
    }

    /// The URDD's own files as last listed: all requests for files of an archive read the same archive.
    ///
    /// # Errors
    /// As [`Shown::open`].
    pub fn own_files(&self) -> Result<Root, ReadError> {
        let known = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, opened)) = known.as_ref() {
            return Ok(opened.own.clone());
        }
        drop(known);
        Ok(self.open()?.1.own)
    }

    /// The path of its folder or archive.
    pub fn path(&self) -> PathBuf {
        self.standing().path.clone()
    }

    /// The assumptions made when it was generated for display.
    pub fn notes(&self) -> Vec<String> {
        self.standing().notes.clone()
    }

    /// Whether its skips can be saved.
    pub fn is_writable(&self) -> bool {
        self.standing().kind == Kind::Writable
    }

    /// Whether it is deleted when the program ends, unless it is saved.
    pub fn is_temporary(&self) -> bool {
        self.standing().kind == Kind::Temporary
    }

    /// Progress of its generation.
    pub fn making(&self) -> Making {
        self.standing().making.clone()
    }

    /// Sets the progress of its generation.
    pub fn set_making(&self, making: Making) {
        self.standing().making = making;
    }

    /// Records that a page has received the failure of its generation.
    pub(super) fn tell_failure(&self) {
        self.failure_told.store(true, Ordering::Relaxed);
    }

    /// Whether a page has received the failure of its generation.
    pub fn is_failure_told(&self) -> bool {
        self.failure_told.load(Ordering::Relaxed)
    }

    /// Marks it as generated, with these assumptions.
    pub fn made(&self, notes: Vec<String>) {
        let mut standing = self.standing();
        standing.notes = notes;
        standing.making = Making::Done;
    }

    /// Records that it is now in a folder of the user.
    pub(super) fn keep_at(&self, path: PathBuf) {
        *self.opened.lock().unwrap_or_else(PoisonError::into_inner) = None;
        let mut standing = self.standing();
        standing.path = path;
        standing.kind = Kind::Writable;
    }

    fn standing(&self) -> MutexGuard<'_, Standing> {
        self.standing.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The robots of a page, in order.
#[derive(Debug, Default)]
pub struct Collection {
    robots: Vec<Arc<Shown>>,
    ids: BTreeSet<String>,
}

impl Collection {
    /// Adds every URDD at or below a path.
    ///
    /// # Errors
    /// If there is none, or the path cannot be searched.
    pub fn add(&mut self, path: &Path) -> Result<(), DiscoverError> {
        for found in discover(path)? {
            // Archives are read-only, and URDDs from before version 1 have no edits.
            let has_metadata = found.path.join(ROOT_METADATA).is_file();
            let kind = match found.closed.is_none() && has_metadata {
                true => Kind::Writable,
                false => Kind::ReadOnly,
            };
            // Absolute: the working directory may change later, and `.` has no name for a sibling to be derived from.
            let path = found.path.canonicalize().unwrap_or(found.path);
            self.put(found.name, path, kind, Making::Done);
        }
        Ok(())
    }

    /// Adds a URDD that is being generated for display, in a temporary folder. The caller reports progress and
    /// completion to the returned value.
    pub fn add_making(&mut self, name: String, path: PathBuf) -> Arc<Shown> {
        let making = Making::Running {
            what: "the URDF".to_owned(),
            done: 0,
            of: 0,
        };
        self.put(name, path, Kind::Temporary, making)
    }

    fn put(&mut self, name: String, path: PathBuf, kind: Kind, making: Making) -> Arc<Shown> {
        let plain = |c: char| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '-' | '_' => c,
            _ => '_',
        };
        let word: String = name.chars().take(80).map(plain).collect();
        let word = if word.is_empty() { "robot" } else { &word };
        let mut id = word.to_owned();
        let mut number = 2;
        while !self.ids.insert(id.clone()) {
            id = format!("{word}.{number}");
            number += 1;
        }
        let shown = Arc::new(Shown {
            id,
            name,
            standing: Mutex::new(Standing {
                path,
                notes: Vec::new(),
                kind,
                making,
            }),
            opened: Mutex::default(),
            failure_told: AtomicBool::new(false),
            report: Mutex::default(),
            picture: Mutex::default(),
            undo: Mutex::default(),
        });
        self.robots.push(Arc::clone(&shown));
        shown
    }

    /// The robots.
    pub fn robots(&self) -> &[Arc<Shown>] {
        &self.robots
    }

    /// Finds a robot by its id.
    pub fn find(&self, id: &str) -> Option<&Shown> {
        let mut robots = self.robots.iter();
        robots.find(|robot| robot.id == id).map(Arc::as_ref)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_plain_and_unique() {
        let mut collection = Collection::default();
        for name in ["arms/a b", "arms/a_b", "<b>", ""] {
            collection.add_making(name.to_owned(), PathBuf::new());
        }
        let ids: Vec<&str> = collection.robots().iter().map(|robot| &*robot.id).collect();
        assert_eq!(ids, ["arms_a_b", "arms_a_b.2", "_b_", "robot"]);
    }
}
