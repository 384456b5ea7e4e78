//! The files that a description of another format may name: what it includes, its meshes and images.
//!
//! A description may come from a stranger, and what an import writes may get published. So files are read only from the
//! folder of the description, from the project that it belongs to, and from the folders that the user allows.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::unreachable::Unreachable;
use crate::files::Files;
use crate::packages::Packages;
use crate::resolve::resolve;
use crate::roots::{Place, Roots, is_broad};
use crate::settings::Settings;
use urdd_directory::read_error::ReadError;

/// Files that a project has in its outermost folder.
const MARKS: &[&str] = &[".git", "package.xml", "pyproject.toml", "setup.py", "model.config"];
/// A file of each folder of a Python package.
const PYTHON: &str = "__init__.py";

/// The folders that may be read.
#[derive(Debug)]
pub struct Reach {
    roots: Roots,
    packages: Packages,
    /// The folders of packages from which files were found.
    opened: RefCell<BTreeSet<PathBuf>>,
    project: Option<PathBuf>,
    /// What was read.
    read: RefCell<Vec<PathBuf>>,
}

impl Reach {
    /// The folders for a description in a folder (symbolic links resolved).
    pub fn new(folder: &Path, settings: &Settings) -> Self {
        let files = &settings.files;
        Reach {
            roots: Roots::new(folder, settings),
            packages: settings.packages.clone(),
            opened: RefCell::default(),
            project: project(folder, files),
            read: RefCell::default(),
        }
    }

    /// Where the files are.
    pub fn files(&self) -> &Files {
        self.roots.files()
    }

    /// Finds the file of a URI, such as `model://arm/meshes/base.dae`, or of a path from a folder.
    ///
    /// # Errors
    /// If there is none, or it is outside of the folders.
    pub fn find(&self, uri: &str, folder: &Path) -> Result<PathBuf, Unreachable> {
        let missing = match resolve(uri, folder, &self.packages, &self.roots) {
            Ok(found) => {
                if let Place::Package(_, folder) = found.place {
                    self.opened.borrow_mut().insert(folder);
                }
                return Ok(found.file);
            }
            Err(missing) => missing,
        };
        match missing.outside {
            Some(file) if self.is_allowed(&file) => Ok(file),
            Some(file) => Err(Unreachable::outside(uri, &file)),
            None => Err(Unreachable::Missing(uri.to_owned())),
        }
    }

    /// Whether a file (symbolic links resolved) is in one of the folders.
    fn is_allowed(&self, file: &Path) -> bool {
        self.project.as_ref().is_some_and(|folder| file.starts_with(folder))
            || self.opened.borrow().iter().any(|folder| file.starts_with(folder))
            || self.roots.place(file, None).is_some()
    }

    /// The files that were read, with symbolic links resolved.
    pub fn into_read(self) -> Vec<PathBuf> {
        self.read.into_inner()
    }

    /// Reads a file of at most `limit` bytes. Gives its path too, with symbolic links resolved.
    ///
    /// # Errors
    /// If it is missing, outside of the folders, too long, or cannot be read.
    pub fn read(&self, path: &Path, limit: u64) -> Result<(PathBuf, Vec<u8>), Unreachable> {
        let shown = || path.display().to_string();
        let Ok(found) = self.files().canonicalize(path) else {
            return Err(Unreachable::Missing(shown()));
        };
        if !self.is_allowed(&found) {
            return Err(Unreachable::outside(&shown(), &found));
        }
        match self.files().read(&found, limit) {
            Ok(bytes) => {
                self.read.borrow_mut().push(found.clone());
                Ok((found, bytes))
            }
            Err(ReadError::Missing) => Err(Unreachable::Missing(shown())),
            Err(error) => Err(Unreachable::Unreadable { file: shown(), reason: error.to_string() }),
        }
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
