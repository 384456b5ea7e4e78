//! The robots that are shown.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use super::save::Files;
use crate::directory::discover::{DiscoverError, ROOT_METADATA, discover};
use crate::directory::root::{ReadError, Root};

/// A robot that is shown.
#[derive(Debug)]
pub struct Shown {
    /// What addresses call it: ASCII letters, digits, `-`, `_` and `.`, unique.
    pub id: String,
    /// What people call it: its path from the folder that was given.
    pub name: String,
    /// Its folder or archive.
    pub path: PathBuf,
    /// What was assumed when it was generated to be shown.
    pub notes: Vec<String>,
    /// Whether its skips may be saved.
    pub writable: bool,
    /// The report, and the revision that it is of.
    pub(super) report: Mutex<Option<(String, String)>>,
    /// The saves that can be undone: the revision that each led to, and the files as they were before.
    pub(super) undo: Mutex<Vec<(String, Files)>>,
}

impl Shown {
    /// Opens it, as it is now.
    ///
    /// # Errors
    /// Where it is not there any more, or cannot be read.
    pub fn open(&self) -> Result<Root, ReadError> {
        Root::open(&self.path)
    }
}

/// The robots of a page, in order.
#[derive(Debug, Default)]
pub struct Collection {
    robots: Vec<Shown>,
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
            let writable = found.closed.is_none() && has_metadata;
            self.put(found.name, found.path, writable, Vec::new());
        }
        Ok(())
    }

    /// Adds a URDD that was generated for this page, with what was assumed.
    pub fn add_generated(&mut self, name: String, path: PathBuf, notes: Vec<String>) {
        self.put(name, path, false, notes);
    }

    fn put(&mut self, name: String, path: PathBuf, writable: bool, notes: Vec<String>) {
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
        self.robots.push(Shown {
            id,
            name,
            path,
            notes,
            writable,
            report: Mutex::default(),
            undo: Mutex::default(),
        });
    }

    /// The robots.
    pub fn robots(&self) -> &[Shown] {
        &self.robots
    }

    /// The robot of this id.
    pub fn find(&self, id: &str) -> Option<&Shown> {
        self.robots.iter().find(|robot| robot.id == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_plain_and_unique() {
        let mut collection = Collection::default();
        for name in ["arms/a b", "arms/a_b", "<b>", ""] {
            collection.add_generated(name.to_owned(), PathBuf::new(), Vec::new());
        }
        let ids: Vec<&str> = collection.robots().iter().map(|robot| &*robot.id).collect();
        assert_eq!(ids, ["arms_a_b", "arms_a_b.2", "_b_", "robot"]);
    }
}
