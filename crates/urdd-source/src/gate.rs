//! The one way to the files that a description names: meshes, images, what it includes.
//!
//! A description may come from a stranger, and what is made of it may get published. So the gate decides from which
//! folders a file is read, as what, and up to which size; it says what it refused, and which files are from elsewhere. A
//! mesh or an image is given out only if it was read as one. It also keeps the account of the run: what was read.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use thiserror::Error;
use urdd_directory::account::{Account, AccountError};
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::listing::ReadError;

use crate::files::{Files, is_broad};
use crate::inspect::{Inspected, inspect, is_image};
use crate::packages::Packages;
use crate::resolve::{FoundMesh, NotFound, resolve};
use crate::roots::{Place, Roots};
use crate::settings::Settings;

/// Files that a project has in its outermost folder.
const MARKS: &[&str] = &[".git", "package.xml", "pyproject.toml", "setup.py", "model.config"];
/// A file of each folder of a Python package.
const PYTHON: &str = "__init__.py";

/// Why an image is not given out.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ImageFault {
    #[error(transparent)]
    Unread(#[from] ReadError),
    #[error(transparent)]
    Account(#[from] AccountError),
}

/// The gate of one description.
#[derive(Debug)]
pub struct Gate {
    folder: PathBuf,
    packages: Packages,
    roots: Roots,
    /// Whether the description is of another format than URDF.
    is_of_project: bool,
    /// Its project, which counts as its own folder.
    project: Option<PathBuf>,
    account: Account,
    seen: Mutex<Seen>,
}

#[derive(Debug, Default)]
struct Seen {
    /// The files that were read.
    read: BTreeSet<PathBuf>,
    /// The packages that files of a description of another format were found in: folder and name.
    opened: BTreeMap<PathBuf, String>,
    /// Of the files that were read, those from elsewhere, and why they were.
    elsewhere: BTreeMap<PathBuf, String>,
}

impl Gate {
    /// The gate of a URDF in a folder (symbolic links resolved).
    pub fn new(folder: &Path, settings: &Settings) -> Self {
        Gate {
            folder: folder.to_owned(),
            packages: settings.packages.clone(),
            roots: Roots::new(folder, settings),
            is_of_project: false,
            project: None,
            account: settings.run_account(),
            seen: Mutex::default(),
        }
    }

    /// The gate of a description of another format in a folder (symbolic links resolved). Its files may be anywhere in its
    /// project, and what it finds in a package may name other files there.
    pub fn of_project(folder: &Path, settings: &Settings) -> Self {
        let mut gate = Gate::new(folder, settings);
        gate.is_of_project = true;
        gate.project = project(folder, &settings.files);
        gate.project.clone().into_iter().for_each(|project| gate.roots.allow(project));
        gate
    }

    /// The account of what was read and may be made of it.
    pub fn account(&self) -> &Account {
        &self.account
    }

    /// Where the files are.
    pub fn files(&self) -> &Files {
        self.roots.files()
    }

    /// Finds the file of a name as the description has it.
    ///
    /// # Errors
    /// If there is none, or it is outside of the folders.
    pub fn find(&self, name: &str) -> Result<FoundMesh, NotFound> {
        self.find_from(name, &self.folder)
    }

    /// As [`Gate::find`], of a file in a folder that the description includes.
    ///
    /// # Errors
    /// If there is none, or it is outside of the folders.
    pub fn find_from(&self, name: &str, folder: &Path) -> Result<FoundMesh, NotFound> {
        let missing = match resolve(name, folder, &self.packages, &self.roots, &self.account) {
            Ok(found) => {
                if let (true, Place::Package(name, folder)) = (self.is_of_project, &found.place) {
                    self.seen().opened.insert(folder.clone(), name.clone());
                }
                return Ok(found);
            }
            Err(missing) => missing,
        };
        let there = missing.outside.as_ref().and_then(|file| Some((file, self.place(file)?)));
        match there {
            Some((file, place)) => Ok(FoundMesh { file: file.clone(), place, assumed: None }),
            None => Err(missing),
        }
    }

    /// The file at a path, if it may be read.
    ///
    /// # Errors
    /// If there is none, or it is outside of the folders.
    pub fn at(&self, path: &Path) -> Result<FoundMesh, NotFound> {
        let Ok(file) = self.files().canonicalize(path) else { return Err(NotFound::default()) };
        match self.place(&file) {
            Some(place) => Ok(FoundMesh { file, place, assumed: None }),
            None => Err(NotFound { outside: Some(file), ..NotFound::default() }),
        }
    }

    /// The folder that a file (symbolic links resolved) may be read from, where no package is named.
    fn place(&self, file: &Path) -> Option<Place> {
        let seen = self.seen();
        let package = file.ancestors().find_map(|above| seen.opened.get_key_value(above));
        match package {
            Some((folder, name)) => Some(Place::Package(name.clone(), folder.clone())),
            None => self.roots.place(file, None),
        }
    }

    /// Reads a mesh that was found, and the files that it names. Its bytes are there if it is one.
    pub fn mesh(&self, found: &FoundMesh) -> Inspected {
        let inspected = inspect(&found.file, &found.place, &self.roots);
        let bytes = inspected.bytes.as_ref().map_or(0, |bytes| bytes.len());
        self.note_read(&found.file, &found.place, bytes);
        for (path, side) in &inspected.side_files {
            self.note_read(path, &side.place, side.bytes.len());
        }
        inspected
    }

    /// Reads an image that was found and that begins with these bytes; `None` if it is not one, which is charged: it may be
    /// named, and so read, many times.
    ///
    /// # Errors
    /// If it cannot be read, or costs too much.
    pub fn image(&self, found: &FoundMesh, start: &[u8]) -> Result<Option<Vec<u8>>, ImageFault> {
        let bytes = self.bytes(found, MAX_DOCUMENT_BYTES)?;
        if bytes.starts_with(start) && is_image(&bytes) {
            return Ok(Some(bytes));
        }
        self.account.charge(bytes.len())?;
        Ok(None)
    }

    /// Reads a file that was found, of at most `limit` bytes: a text, or what a program reads of a mesh. It is not to be
    /// carried.
    ///
    /// # Errors
    /// If it cannot be read, or is longer.
    pub fn bytes(&self, found: &FoundMesh, limit: u64) -> Result<Vec<u8>, ReadError> {
        let bytes = self.files().read(&found.file, limit)?;
        self.note_read(&found.file, &found.place, bytes.len());
        Ok(bytes)
    }

    /// Adds a file to what was read, once.
    fn note_read(&self, file: &Path, place: &Place, bytes: usize) {
        let elsewhere = self.elsewhere(file, place);
        let mut seen = self.seen();
        seen.elsewhere.extend(elsewhere.map(|why| (file.to_owned(), why)));
        if seen.read.insert(file.to_owned()) {
            self.account.deposit(bytes);
        }
    }

    /// Why a file may be read, if it is from outside of the description's folder, package and project.
    pub fn elsewhere(&self, file: &Path, place: &Place) -> Option<String> {
        let is_of_project = self.project.as_ref().is_some_and(|project| file.starts_with(project));
        let is_own = is_of_project || self.roots.is_own(file);
        (!is_own).then(|| match place {
            Place::Package(name, _) => format!("since it belongs to the package `{name}`"),
            Place::Own | Place::Allowed => "since --allow-folder allows it".to_owned(),
        })
    }

    /// The files that were read from elsewhere, with symbolic links resolved, and why they may be.
    pub fn all_elsewhere(&self) -> BTreeMap<PathBuf, String> {
        self.seen().elsewhere.clone()
    }

    /// The files that were read, with symbolic links resolved.
    pub fn into_read(self) -> Vec<PathBuf> {
        let seen = self.seen.into_inner().unwrap_or_else(PoisonError::into_inner);
        seen.read.into_iter().collect()
    }

    fn seen(&self) -> MutexGuard<'_, Seen> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The outermost folder of the Python package that holds a folder, or the nearest folder above with a mark of a project.
fn project(folder: &Path, files: &Files) -> Option<PathBuf> {
    let is_python = |folder: &&Path| files.is_file(&folder.join(PYTHON));
    let is_marked = |folder: &&Path| MARKS.iter().any(|mark| files.exists(&folder.join(mark)));
    let first = folder.ancestors().find(|above| is_python(above) || is_marked(above))?;
    let python = first.ancestors().take_while(is_python).last();
    // A home folder that is kept in Git is no project.
    Some(python.unwrap_or(first)).filter(|folder| !is_broad(folder)).map(Path::to_owned)
}
