//! The root of a URDD in any storage: lists its contents, and reads files without ever leaving the root.

use std::path::Path;
use std::sync::Arc;

use crate::file_type::is_archive;
pub use crate::listing::{Entry, EntryKind, Listing, ReadError};
use crate::source::{Archive, Disk, OpenFile, Source};
use crate::{path, regular};

/// The root of a URDD.
#[derive(Debug, Clone)]
pub struct Root {
    source: Arc<dyn Source>,
}

impl Root {
    /// Opens a folder or a zip archive.
    ///
    /// # Errors
    /// If it does not exist, is neither, or cannot be accessed.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        match is_archive(path) {
            true => Ok(Self::of(Archive::open(path)?)),
            false => Self::open_folder(path),
        }
    }

    /// Opens a folder.
    ///
    /// # Errors
    /// If it does not exist, is not a folder, or cannot be accessed.
    pub fn open_folder(path: &Path) -> Result<Self, ReadError> {
        Ok(Self::of(Disk::open(path)?))
    }

    /// The root of a source.
    pub fn of(source: impl Source + 'static) -> Self {
        let source = Arc::new(source);
        Root { source }
    }

    /// The files as they are now: a later read of one that changed is [`ReadError::Changed`].
    #[must_use]
    pub fn kept(&self) -> Self {
        let source = self.source.kept().unwrap_or_else(|| Arc::clone(&self.source));
        Root { source }
    }

    /// The folder on disk, if any. An archive has none and is read-only.
    pub fn folder(&self) -> Option<&Path> {
        self.source.folder()
    }

    /// Name of the root folder.
    pub fn folder_name(&self) -> String {
        self.source.folder_name()
    }

    /// Lists everything below the root. Does not follow links.
    ///
    /// # Errors
    /// If the root itself cannot be listed.
    pub fn list(&self) -> Result<Listing, ReadError> {
        self.source.list()
    }

    /// Reads a file of at most `limit` bytes.
    ///
    /// # Errors
    /// If SPEC 2.8 forbids the path, it leads out of the root, or it cannot be read.
    pub fn read(&self, relative: &str, limit: u64) -> Result<Vec<u8>, ReadError> {
        let (file, size) = self.open_file(relative)?;
        regular::read_sized(file, size, limit)
    }

    /// Opens a file for reading, and returns its size.
    ///
    /// # Errors
    /// As for [`Root::read`].
    pub fn open_file(&self, relative: &str) -> Result<(OpenFile, u64), ReadError> {
        path::check(relative)?;
        self.source.open(relative)
    }

    /// A URDD in the same parent folder: legacy mesh paths may lead there.
    pub fn sibling(&self, folder_name: &str) -> Option<Root> {
        path::check(folder_name).ok()?;
        if folder_name.contains('/') {
            return None;
        }
        let source = self.source.sibling(folder_name)?;
        Some(Root { source })
    }
}

impl Source for Root {
    fn folder_name(&self) -> String {
        self.source.folder_name()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        self.source.list()
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        self.source.open(path)
    }

    fn sibling(&self, folder_name: &str) -> Option<Arc<dyn Source>> {
        self.source.sibling(folder_name)
    }

    fn kept(&self) -> Option<Arc<dyn Source>> {
        self.source.kept()
    }

    fn folder(&self) -> Option<&Path> {
        self.source.folder()
    }
}
