//! Files and folders in memory, used to build cases before they are written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fs, io};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;
use urdd_directory::outputs;

/// A path with forward slashes, relative to the URDD's root; `../` leads to files beside the URDD. Stored as bytes,
/// because most systems allow names that are not UTF-8.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(from = "Written")]
pub struct FilePath(Vec<u8>);

#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Text(String),
    Bytes { base64: Base64 },
}

impl From<Written> for FilePath {
    fn from(path: Written) -> FilePath {
        FilePath(match path {
            Written::Text(text) => text.into_bytes(),
            Written::Bytes { base64: Base64(bytes) } => bytes,
        })
    }
}

/// Bytes, in base64 in a file of the suite.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Base64(pub Vec<u8>);

impl TryFrom<String> for Base64 {
    type Error = base64::DecodeError;

    fn try_from(text: String) -> Result<Base64, Self::Error> {
        STANDARD.decode(text).map(Base64)
    }
}

impl From<&str> for FilePath {
    fn from(text: &str) -> Self {
        FilePath(text.as_bytes().to_vec())
    }
}

impl std::fmt::Display for FilePath {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        String::from_utf8_lossy(&self.0).fmt(f)
    }
}

impl FilePath {
    /// Converts a system path; `None` if this system cannot express it as bytes.
    pub fn from_os(path: &Path) -> Option<Self> {
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt;
            Some(FilePath(path.as_os_str().as_bytes().to_vec()))
        }
        #[cfg(not(unix))]
        {
            let text = path.to_str()?.replace('\\', "/");
            Some(FilePath(text.into_bytes()))
        }
    }

    /// The system path; `None` if the system does not allow such names.
    fn to_os(&self) -> Option<PathBuf> {
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt;
            Some(std::ffi::OsStr::from_bytes(&self.0).into())
        }
        #[cfg(not(unix))]
        {
            std::str::from_utf8(&self.0).ok().map(PathBuf::from)
        }
    }

    /// The path, in whatever encoding.
    pub fn as_bytes(&self) -> &[u8] {
        &self.0
    }

    /// The path as text, if it is UTF-8.
    pub fn as_str(&self) -> Option<&str> {
        std::str::from_utf8(&self.0).ok()
    }

    /// The path after moving `from` to `to`. The path must be `from` or below it.
    pub fn moved(&self, from: &FilePath, to: &FilePath) -> FilePath {
        let rest = self.0.get(from.0.len()..).unwrap_or_default();
        FilePath([&to.0, rest].concat())
    }

    /// Whether it is `folder` or below it.
    pub fn is_within(&self, folder: &FilePath) -> bool {
        let rest = self.0.strip_prefix(folder.0.as_slice());
        rest.is_some_and(|rest| rest.first().is_none_or(|next| *next == b'/'))
    }
}

/// The node at a path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Node {
    /// A file.
    File(Arc<[u8]>),
    /// A symbolic link with its target.
    Link(FilePath),
    /// An empty folder. Other folders are implied by their contents.
    Folder,
}

/// A URDD and the files beside it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tree {
    /// Nodes by path.
    pub nodes: BTreeMap<FilePath, Node>,
}

/// Why a tree could not be written or read.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum TreeError {
    #[error("{path}: cannot be written: {1}", path = .0.display())]
    Write(PathBuf, io::Error),
    #[error("{path}: cannot be read: {1}", path = .0.display())]
    Read(PathBuf, io::Error),
    #[error("{path}: cannot be removed: {1}", path = .0.display())]
    Remove(PathBuf, io::Error),
    #[error("{0}: this operating system cannot store it")]
    Unsupported(String),
    #[error("`archive` names the entry {0:?}, and the archive has none of this name")]
    NoEntry(String),
}

impl Tree {
    /// The bytes of a file.
    pub fn file(&self, path: &str) -> Option<&[u8]> {
        match self.nodes.get(&path.into()) {
            Some(Node::File(bytes)) => Some(bytes),
            _ => None,
        }
    }

    /// Adds or replaces a file.
    pub fn put(&mut self, path: FilePath, bytes: impl Into<Arc<[u8]>>) {
        self.nodes.insert(path, Node::File(bytes.into()));
    }

    /// These files, with paths relative to `root`, a folder among them.
    pub fn of<'a>(files: impl Iterator<Item = (&'a str, &'a [u8])>, root: &str) -> Tree {
        let mut tree = Tree::default();
        for (path, bytes) in files {
            let path = from_root(Path::new(path), Path::new(root));
            if let Some(path) = FilePath::from_os(&path) {
                tree.put(path, bytes);
            }
        }
        tree
    }

    /// Reads a folder. Paths are relative to `root`, a folder inside it.
    ///
    /// # Errors
    /// If something cannot be read.
    pub fn read(folder: &Path, root: &Path) -> Result<Tree, TreeError> {
        let mut tree = Tree::default();
        let root_name = root.strip_prefix(folder).unwrap_or(Path::new(""));
        tree.read_below(folder, Path::new(""), root_name)?;
        Ok(tree)
    }

    /// Returns whether the folder has any entries.
    fn read_below(&mut self, folder: &Path, inside: &Path, root: &Path) -> Result<bool, TreeError> {
        let path = folder.join(inside);
        let failed = |error| TreeError::Read(path.clone(), error);
        let mut any = false;
        for entry in fs::read_dir(&path).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            any = true;
            let inside = inside.join(entry.file_name());
            let unsupported = || TreeError::Unsupported(inside.display().to_string());
            let name = FilePath::from_os(&from_root(&inside, root)).ok_or_else(unsupported)?;
            let kind = entry.file_type().map_err(failed)?;
            let path = entry.path();
            let failed = |error| TreeError::Read(path.clone(), error);
            if kind.is_symlink() {
                let target = fs::read_link(&path).map_err(failed)?;
                let target = FilePath::from_os(&target).ok_or_else(unsupported)?;
                self.nodes.insert(name, Node::Link(target));
            } else if kind.is_dir() {
                if !self.read_below(folder, &inside, root)? {
                    self.nodes.insert(name, Node::Folder);
                }
            } else {
                let bytes = fs::read(&path).map_err(failed)?;
                self.put(name, bytes);
            }
        }
        Ok(any)
    }

    /// Writes everything; `root` becomes the URDD's folder.
    ///
    /// # Errors
    /// If something cannot be written, or this operating system does not support it.
    pub fn write(&self, root: &Path) -> Result<(), TreeError> {
        make_folder(root)?;
        for (name, node) in &self.nodes {
            let unsupported = || TreeError::Unsupported(name.to_string());
            let path = name.to_os().ok_or_else(unsupported)?;
            let path = match path.strip_prefix("..") {
                Ok(beside) => root.with_file_name("").join(beside),
                Err(_) => root.join(&path),
            };
            if let Some(folder) = path.parent() {
                make_folder(folder)?;
            }
            match node {
                Node::Folder => make_folder(&path)?,
                // Some file systems only support Unicode names.
                Node::File(bytes) => write_file(&path, bytes)
                    .map_err(|error| if name.as_str().is_none() { unsupported() } else { error })?,
                Node::Link(target) => {
                    let target = target.to_os().ok_or_else(unsupported)?;
                    let linked = link(&target, &path).ok_or_else(unsupported)?;
                    linked.map_err(|error| TreeError::Write(path, error))?;
                }
            }
        }
        Ok(())
    }
}

/// Makes a path relative to `root`. Both are relative to the same folder.
fn from_root(path: &Path, root: &Path) -> PathBuf {
    match path.strip_prefix(root) {
        Ok(below) => below.to_owned(),
        Err(_) => Path::new("..").join(path),
    }
}

#[cfg(unix)]
fn link(target: &Path, path: &Path) -> Option<io::Result<()>> {
    Some(std::os::unix::fs::symlink(target, path))
}

/// On other systems, file links and folder links differ, and creating them requires a privilege.
#[cfg(not(unix))]
fn link(_: &Path, _: &Path) -> Option<io::Result<()>> {
    None
}

pub(crate) fn make_folder(path: &Path) -> Result<(), TreeError> {
    fs::create_dir_all(path).map_err(|error| TreeError::Write(path.to_owned(), error))
}

pub(crate) fn remove_folder(path: &Path) -> Result<(), TreeError> {
    fs::remove_dir_all(path).map_err(|error| TreeError::Remove(path.to_owned(), error))
}

pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), TreeError> {
    outputs::fresh(path, bytes).map_err(|error| TreeError::Write(path.to_owned(), error))
}
