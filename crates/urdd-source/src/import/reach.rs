//! The files that a description of another format may name: what it includes, its meshes and images.
//!
//! A description may come from a stranger, and what an import writes may get published. So files are read only from the
//! folder of the description, from the project that it belongs to, and from the folders that the user allows.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::unreachable::Unreachable;
use crate::files::Files;
use crate::inspect::{Inspected, inspect};
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
    /// The folders of packages from which files were found, with their names.
    opened: RefCell<BTreeMap<PathBuf, String>>,
    /// What was read.
    read: RefCell<Vec<PathBuf>>,
}

impl Reach {
    /// The folders for a description in a folder (symbolic links resolved).
    pub fn new(folder: &Path, settings: &Settings) -> Self {
        let mut roots = Roots::new(folder, settings);
        if let Some(project) = project(folder, &settings.files) {
            roots.allow(project);
        }
        Reach {
            roots,
            packages: settings.packages.clone(),
            opened: RefCell::default(),
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
                if let Place::Package(name, folder) = found.place {
                    self.opened.borrow_mut().insert(folder, name);
                }
                return Ok(found.file);
            }
            Err(missing) => missing,
        };
        match missing.outside {
            Some(file) if self.place(&file).is_some() => Ok(file),
            Some(file) => Err(Unreachable::outside(uri, &file)),
            None => Err(Unreachable::Missing(uri.to_owned())),
        }
    }

    /// The folder that a file (symbolic links resolved) may be read from.
    fn place(&self, file: &Path) -> Option<Place> {
        let opened = self.opened.borrow();
        let package = opened.iter().find(|(folder, _)| file.starts_with(folder));
        match package {
            Some((folder, name)) => Some(Place::Package(name.clone(), folder.clone())),
            None => self.roots.place(file, None),
        }
    }

    /// Inspects a mesh that [`Reach::find`] found, and the files that it names, as those of a URDF are.
    pub fn inspect(&self, mesh: &Path) -> Inspected {
        let place = self.place(mesh).unwrap_or(Place::Own);
        let inspected = inspect(mesh, &place, &self.roots);
        let read = [mesh.to_owned()].into_iter().chain(inspected.side_files.keys().cloned());
        self.read.borrow_mut().extend(read);
        inspected
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
        if self.place(&found).is_none() {
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
