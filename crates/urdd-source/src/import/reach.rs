//! The files that a description of another format may name: what it includes, its meshes and images.
//!
//! A description may come from a stranger, and what an import writes may get published. So files are read only from the
//! folder of the description, from the project that it belongs to, and from the folders that the user allows.

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::files::Files;
use crate::roots::Roots;
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
    project: Option<PathBuf>,
    /// What was read.
    read: RefCell<Vec<PathBuf>>,
}

/// Why a file is not read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Unreachable {
    #[error("`{0}` was not found")]
    Missing(String),
    #[error(
        "`{file}` is outside of the folders of the description; `--allow-folder {}` allows its folder", folder.display()
    )]
    Outside { file: String, folder: PathBuf },
    #[error("`{file}` cannot be read: {reason}")]
    Unreadable { file: String, reason: String },
}

impl Reach {
    /// The folders for a description in a folder (symbolic links resolved).
    pub fn new(folder: &Path, settings: &Settings) -> Self {
        let files = &settings.files;
        Reach {
            roots: Roots::new(folder, settings),
            project: project(folder, files),
            read: RefCell::default(),
        }
    }

    /// Where the files are.
    pub fn files(&self) -> &Files {
        self.roots.files()
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
        let is_in_project = self.project.as_ref().is_some_and(|folder| found.starts_with(folder));
        if !is_in_project && self.roots.place(&found, None).is_none() {
            let folder = found.parent().unwrap_or(&found).to_owned();
            return Err(Unreachable::Outside { file: shown(), folder });
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
    Some(python.unwrap_or(first).to_owned())
}
