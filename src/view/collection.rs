//! The robots that are shown.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::revision;
use super::save::Files;
use urdd_directory::carried::carried;
use urdd_directory::discover::{DiscoverError, ROOT_METADATA, discover};
use urdd_directory::root::{ReadError, Root};

/// A robot that is shown.
#[derive(Debug)]
pub struct Shown {
    /// What addresses call it: ASCII letters, digits, `-`, `_` and `.`, unique.
    pub id: String,
    /// What people call it: its path from the folder that was given.
    pub name: String,
    standing: Mutex<Standing>,
    /// The files, and the revision that they are of.
    opened: Mutex<Option<(String, Opened)>>,
    /// Whether a page was told that its generation failed.
    failure_told: AtomicBool,
    /// The report, and the revision that it is of.
    pub(super) report: Mutex<Option<(String, String)>>,
    /// The picture, and the revision that it is of.
    pub(super) picture: Mutex<Option<(String, Option<Vec<u8>>)>>,
    /// The saves that can be undone: the revision that each led to, and the files as they were before.
    pub(super) undo: Mutex<Vec<(String, Files)>>,
}

/// What may change of a robot that is shown.
#[derive(Debug)]
struct Standing {
    path: PathBuf,
    notes: Vec<String>,
    kind: Kind,
    making: Making,
}

/// What may be done with a robot's files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// An archive, or from before version 1: it is not written to.
    ReadOnly,
    /// A folder of version 1: skips are saved.
    Writable,
    /// Generated to be shown: it can be saved as a whole, into a folder.
    Temporary,
}

/// How far the generation of a robot is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Making {
    /// It is there.
    Done,
    /// A module is being made, after so many of so many.
    Running {
        /// The module.
        what: String,
        /// Modules that are done.
        done: usize,
        /// Modules in all.
        of: usize,
    },
    /// There will be none.
    Failed(String),
}

/// The files of a robot that is shown. An archive is in memory once, however many ask.
#[derive(Debug, Clone)]
pub struct Opened {
    /// All of them: for the validator.
    pub all: Root,
    /// The URDD's own (see [`carried`]): for everybody else.
    pub own: Root,
}

impl Shown {
    /// The files as they are now, and the revision that they are of.
    ///
    /// # Errors
    /// Where they are not there any more, or cannot be read.
    pub fn open(&self) -> Result<(String, Opened), ReadError> {
        let path = self.path();
        // Before the files are listed: what changes afterwards is noticed.
        let revision = revision::of(&path);
        let mut opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of, known)) = opened.as_ref()
            && *of == revision
        {
            return Ok((revision, known.clone()));
        }
        // Not two at once.
        *opened = None;
        let all = Root::open(&path)?;
        let own = carried(&all)?;
        let found = Opened { all, own };
        *opened = Some((revision.clone(), found.clone()));
        Ok((revision, found))
    }

    /// The URDD's own files as they were listed last: each request for a file of an archive reads the same archive.
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

    /// Its folder or archive.
    pub fn path(&self) -> PathBuf {
        self.standing().path.clone()
    }

    /// What was assumed when it was generated to be shown.
    pub fn notes(&self) -> Vec<String> {
        self.standing().notes.clone()
    }

    /// Whether its skips may be saved.
    pub fn is_writable(&self) -> bool {
        self.standing().kind == Kind::Writable
    }

    /// Whether it goes when the program ends, unless it is saved.
    pub fn is_temporary(&self) -> bool {
        self.standing().kind == Kind::Temporary
    }

    /// How far its generation is.
    pub fn making(&self) -> Making {
        self.standing().making.clone()
    }

    /// Tells how far its generation is.
    pub fn set_making(&self, making: Making) {
        self.standing().making = making;
    }

    /// A page is told that its generation failed.
    pub(super) fn tell_failure(&self) {
        self.failure_told.store(true, Ordering::Relaxed);
    }

    /// Whether a page was told that its generation failed.
    pub fn is_failure_told(&self) -> bool {
        self.failure_told.load(Ordering::Relaxed)
    }

    /// It was generated, with these assumptions.
    pub fn made(&self, notes: Vec<String>) {
        let mut standing = self.standing();
        standing.notes = notes;
        standing.making = Making::Done;
    }

    /// It lies in a folder of a person's now.
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
    /// Where there is none, or the path cannot be searched.
    pub fn add(&mut self, path: &Path) -> Result<(), DiscoverError> {
        for found in discover(path)? {
            // Not archives; and URDDs of before version 1 have no edits.
            let has_metadata = found.path.join(ROOT_METADATA).is_file();
            let kind = match found.closed.is_none() && has_metadata {
                true => Kind::Writable,
                false => Kind::ReadOnly,
            };
            // As it is now: the program may run elsewhere later, and `.` has no name to write beside.
            let path = found.path.canonicalize().unwrap_or(found.path);
            self.put(found.name, path, kind, Making::Done);
        }
        Ok(())
    }

    /// Adds a URDD that is being generated to be shown, at a place that goes with the program. What this gives is told
    /// how far that is, and when it is done.
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

    /// The robot of this id.
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
