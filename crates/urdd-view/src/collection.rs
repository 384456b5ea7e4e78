//! The displayed robots.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use parking_lot::Mutex;

use crate::card::Card;
use crate::drop_folder::Drops;
use crate::revision;
use crate::states::States;
use urdd_directory::carried::carried;
use urdd_directory::discover::{DiscoverError, ROOT_METADATA, discover};
use urdd_directory::replacement::Files;
use urdd_directory::root::{ReadError, Root};
use urdd_generate::Settings;
use urdd_robot::Robot;
use urdd_source::Settings as SourceSettings;

/// A displayed robot.
#[derive(Debug)]
pub struct Shown {
    /// Its unique identifier in URLs: ASCII letters, digits, `-`, `_` and `.`.
    pub id: String,
    /// Its displayed name: its path from the given folder.
    pub name: String,
    /// The URDF that it is generated from; `None` for a URDD.
    pub source: Option<Source>,
    /// The configurations that a program shows.
    pub states: Arc<States>,
    standing: Mutex<Standing>,
    /// The files, and their revision.
    opened: Mutex<Option<(String, Opened)>>,
    /// When a page last asked for it.
    seen: Mutex<Option<Instant>>,
    /// The report, and its revision.
    pub(super) report: Mutex<Option<(String, String)>>,
    /// The picture, and its revision.
    pub(super) picture: Mutex<Option<(String, Option<Vec<u8>>)>>,
    /// The picture of its card before it is generated.
    pub(super) card: Card,
    /// The saves that can be undone: the revision after each, and the files before it.
    pub(super) undo: Mutex<Vec<(String, Files)>>,
}

/// What a robot is generated from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The URDF or xacro file.
    pub file: PathBuf,
    /// Folders of packages besides those of the settings, each as `NAME=PATH`.
    pub packages: Vec<String>,
    /// Arguments for xacro that are declared of it, each as `name:=value`.
    pub arguments: Vec<String>,
}

impl Source {
    /// The settings to read it with: with its own packages and arguments.
    pub fn settings(&self, all: &Settings) -> Settings {
        let source = self.with_packages(&all.source).with_declared(&self.arguments);
        Settings { source, ..all.clone() }
    }

    /// These settings with its own packages.
    pub(super) fn with_packages(&self, all: &SourceSettings) -> SourceSettings {
        let mut settings = all.clone();
        for package in &self.packages {
            // A folder that is gone: its meshes are not found, and the page says so.
            let _ = settings.packages.add(package);
        }
        settings
    }
}

#[derive(Debug)]
struct Standing {
    path: PathBuf,
    /// Whether there is something to show at that path.
    is_ready: bool,
    notes: Vec<String>,
    kind: Access,
    making: Making,
}

/// The operations allowed on a robot's files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Access {
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
    /// Nobody has opened it yet.
    Waiting,
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
    /// The robot.
    pub robot: Arc<Robot>,
}

impl Opened {
    /// The files of a robot, as they are now.
    fn of(root: &Root) -> Result<Self, ReadError> {
        let all = root.kept();
        let own = carried(&all)?;
        Ok(Opened { robot: Arc::new(Robot::of(own.clone())), own, all })
    }
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
        let mut opened = self.opened.lock();
        if let Some((of, known)) = opened.as_ref()
            && *of == revision
        {
            return Ok((revision, known.clone()));
        }
        // Drops the old archive first: only one is in memory.
        *opened = None;
        let found = Opened::of(&Root::open(&path)?)?;
        *opened = Some((revision.clone(), found.clone()));
        Ok((revision, found))
    }

    /// The URDD's own files as last listed: all requests for files of an archive read the same archive.
    ///
    /// # Errors
    /// As [`Shown::open`].
    pub fn own_files(&self) -> Result<Root, ReadError> {
        let known = self.opened.lock().as_ref().map(|(_, opened)| opened.own.clone());
        known.map_or_else(|| Ok(self.open()?.1.own), Ok)
    }

    /// The path of its folder or archive.
    pub fn path(&self) -> PathBuf {
        self.standing.lock().path.clone()
    }

    /// The assumptions made when it was generated for display.
    pub fn notes(&self) -> Vec<String> {
        self.standing.lock().notes.clone()
    }

    /// Whether its skips can be saved.
    pub fn is_writable(&self) -> bool {
        self.standing.lock().kind == Access::Writable
    }

    /// Whether it is deleted when the program ends, unless it is saved.
    pub fn is_temporary(&self) -> bool {
        self.standing.lock().kind == Access::Temporary
    }

    /// Progress of its generation.
    pub fn making(&self) -> Making {
        self.standing.lock().making.clone()
    }

    /// Sets the progress of its generation.
    pub fn set_making(&self, making: Making) {
        self.standing.lock().making = making;
    }

    /// Whether there is something to show.
    pub fn is_ready(&self) -> bool {
        self.standing.lock().is_ready
    }

    /// Records that a page shows it, or waits for it.
    pub fn see(&self) {
        *self.seen.lock() = Some(Instant::now());
    }

    /// How long ago a page last asked for it.
    pub fn unseen_for(&self) -> Option<Duration> {
        self.seen.lock().map(|seen| seen.elapsed())
    }

    /// Shows what was generated at a path, with these assumptions, while `making` goes on. Not if it was saved
    /// meanwhile.
    pub fn show(&self, path: PathBuf, notes: Vec<String>, making: Making) {
        let mut standing = self.standing.lock();
        if standing.kind == Access::Temporary {
            standing.path = path;
            standing.notes = notes;
            standing.making = making;
            standing.is_ready = true;
        }
    }

    /// Records that it is now in a folder of the user.
    pub(super) fn keep_at(&self, path: PathBuf) {
        *self.opened.lock() = None;
        let mut standing = self.standing.lock();
        standing.path = path;
        standing.kind = Access::Writable;
        standing.making = Making::Done;
    }
}

/// The robots of a page, in order. Robots may be added while it is shown.
#[derive(Debug, Default)]
pub struct Collection {
    listed: Mutex<Listed>,
    /// Where dropped files go, if they are accepted.
    pub(super) drops: Option<Drops>,
    /// How URDFs are read.
    pub(super) settings: Settings,
}

#[derive(Debug, Default)]
struct Listed {
    robots: Vec<Arc<Shown>>,
    ids: BTreeSet<String>,
}

impl Collection {
    /// Accepts URDFs that are dropped on the page, into this folder. `with_xacro` allows them to run xacro.
    #[must_use]
    pub fn with_drops(self, folder: PathBuf, with_xacro: bool) -> Self {
        Collection { drops: Some(Drops::new(folder, with_xacro)), ..self }
    }

    /// Reads URDFs by these settings.
    #[must_use]
    pub fn with_settings(self, settings: Settings) -> Self {
        Collection { settings, ..self }
    }

    /// Adds every URDD at or below a path.
    ///
    /// # Errors
    /// If there is none, or the path cannot be searched.
    pub fn add(&self, path: &Path) -> Result<(), DiscoverError> {
        for found in discover(path)? {
            // Archives are read-only, and URDDs from before version 1 have no edits.
            let has_metadata = found.path.join(ROOT_METADATA).is_file();
            let kind = match found.closed.is_none() && has_metadata {
                true => Access::Writable,
                false => Access::ReadOnly,
            };
            // Absolute: the working directory may change later, and `.` has no name for a sibling to be derived from.
            let path = found.path.canonicalize().unwrap_or(found.path);
            self.put(found.name, None, path, kind);
        }
        Ok(())
    }

    /// Adds the URDD at a root: the page shows these files, whatever happens at its path.
    ///
    /// # Errors
    /// If they cannot be listed.
    pub fn add_root(&self, root: &Root) -> Result<Arc<Shown>, ReadError> {
        let opened = Opened::of(root)?;
        let shown = self.put(root.folder_name(), None, PathBuf::new(), Access::ReadOnly);
        *shown.opened.lock() = Some((revision::GONE.to_owned(), opened));
        Ok(shown)
    }

    /// Adds a robot to be generated from a URDF when somebody opens it.
    pub fn add_source(&self, name: String, source: Source) -> Arc<Shown> {
        self.put(name, Some(source), PathBuf::new(), Access::Temporary)
    }

    fn put(&self, name: String, source: Option<Source>, path: PathBuf, kind: Access) -> Arc<Shown> {
        let plain = |c: char| match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '-' | '_' => c,
            _ => '_',
        };
        let word: String = name.chars().take(80).map(plain).collect();
        let word = if word.is_empty() { "robot" } else { &word };
        let mut id = word.to_owned();
        let mut number = 2;
        let mut listed = self.listed.lock();
        while !listed.ids.insert(id.clone()) {
            id = format!("{word}.{number}");
            number += 1;
        }
        let is_made = source.is_none();
        let shown = Arc::new(Shown {
            id,
            name,
            source,
            states: Arc::default(),
            standing: Mutex::new(Standing {
                path,
                is_ready: is_made,
                notes: Vec::new(),
                kind,
                making: if is_made { Making::Done } else { Making::Waiting },
            }),
            opened: Mutex::default(),
            seen: Mutex::default(),
            report: Mutex::default(),
            picture: Mutex::default(),
            card: Card::default(),
            undo: Mutex::default(),
        });
        listed.robots.push(Arc::clone(&shown));
        shown
    }

    /// The robots.
    pub fn robots(&self) -> Vec<Arc<Shown>> {
        self.listed.lock().robots.clone()
    }

    /// Takes out a robot, by its id.
    pub fn remove(&self, id: &str) {
        self.listed.lock().robots.retain(|robot| robot.id != id);
    }

    /// Finds a robot by its id.
    pub fn find(&self, id: &str) -> Option<Arc<Shown>> {
        self.listed.lock().robots.iter().find(|robot| robot.id == id).cloned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_plain_and_unique() {
        let collection = Collection::default();
        for name in ["arms/a b", "arms/a_b", "<b>", ""] {
            let source =
                Source { file: PathBuf::new(), packages: Vec::new(), arguments: Vec::new() };
            collection.add_source(name.to_owned(), source);
        }
        let robots = collection.robots();
        let ids: Vec<&str> = robots.iter().map(|robot| &*robot.id).collect();
        assert_eq!(ids, ["arms_a_b", "arms_a_b.2", "_b_", "robot"]);
    }
}
