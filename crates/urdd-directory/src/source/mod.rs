//! Storage of files by path: a folder, memory, or a zip archive. Of a URDD, and of what is around a description that is
//! not on the disk.

mod archive;
mod disk;
mod memory;
mod zip_list;

use std::fmt;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use crate::listing::{Listing, ReadError};
pub use archive::Archive;
pub use disk::{Disk, Stamp, is_urdd};
pub use memory::{Item, Lend, Memory, Node, Tree};

/// A file open for reading.
pub type OpenFile = Box<dyn Read + Send>;

/// Storage of files. Paths are relative to its root, with forward slashes. The caller has checked those of a URDD against
/// SPEC 2.8.
pub trait Source: fmt::Debug + Send + Sync {
    /// Name of the root folder.
    fn folder_name(&self) -> String;

    /// Lists everything below the root. Does not follow links.
    ///
    /// # Errors
    /// If the root itself cannot be listed.
    fn list(&self) -> Result<Listing, ReadError>;

    /// Opens a regular file, and returns its size in bytes.
    ///
    /// # Errors
    /// If it is missing, a link leads out of the root, or it cannot be read.
    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError>;

    /// The URDD with this folder name in the same parent folder, if the source supports it.
    fn sibling(&self, _folder_name: &str) -> Option<Arc<dyn Source>> {
        None
    }

    /// The files as they are now: a later read of one that changed is [`ReadError::Changed`]. `None` if they never change.
    fn kept(&self) -> Option<Arc<dyn Source>> {
        None
    }

    /// The writable folder on disk, if any.
    fn folder(&self) -> Option<&Path> {
        None
    }
}
