//! Robots that a person declares: xacro files with their arguments.

use std::path::{Path, PathBuf};

/// A robot that a person declares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Declared {
    /// The URDF or xacro file.
    pub source: PathBuf,
    /// Its name, if it has another one than its file.
    pub name: Option<String>,
    /// Arguments for xacro, each as `name:=value`.
    pub arguments: Vec<String>,
}

impl From<PathBuf> for Declared {
    /// A file that nobody declares.
    fn from(source: PathBuf) -> Self {
        Declared { source, name: None, arguments: Vec::new() }
    }
}

/// The robots that are declared of a file, with its path as it is given; else the file itself.
pub fn robots_of(file: PathBuf, declared: &[Declared]) -> Vec<Declared> {
    let found = declared_of(&file, declared);
    if found.is_empty() { vec![file.into()] } else { found }
}

/// The robots that are declared of a file, with its path as it is given; none if none is.
pub fn declared_of(file: &Path, declared: &[Declared]) -> Vec<Declared> {
    let is_it = |one: &&Declared| is_same(&one.source, file);
    let with_path = |one: &Declared| Declared { source: file.to_owned(), ..one.clone() };
    declared.iter().filter(is_it).map(with_path).collect()
}

/// The files that are declared below a folder, by paths that begin with it as it is given.
pub fn files_below(folder: &Path, declared: &[Declared]) -> Vec<PathBuf> {
    let Ok(above) = folder.canonicalize() else { return Vec::new() };
    let inside = |one: &Declared| {
        let file = one.source.canonicalize().ok()?;
        Some(folder.join(file.strip_prefix(&above).ok()?))
    };
    declared.iter().filter_map(inside).collect()
}

/// Whether two paths lead to one file. Most have other names, and need no look at the disk.
fn is_same(one: &Path, other: &Path) -> bool {
    let is_one =
        || one.canonicalize().is_ok_and(|one| other.canonicalize().is_ok_and(|other| one == other));
    one == other || one.file_name() == other.file_name() && is_one()
}
