//! Where the files of a URDD lie: in a folder, in memory, or in a zip archive.

mod archive;
mod disk;
mod memory;
mod tree;
mod zip_list;

use std::fmt;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use super::listing::Listing;
use super::read_error::ReadError;

pub use archive::{Archive, is_archive};
pub use disk::{Disk, is_urdd};
pub use memory::Memory;

/// A file that is open for reading.
pub type OpenFile = Box<dyn Read + Send>;

/// Where the files of one URDD lie. Paths are relative to the URDD's root, with forward slashes;
/// who calls this has checked that they are such as SPEC 2.8 allows.
pub trait Source: fmt::Debug + Send + Sync {
    /// The name of the root folder.
    fn folder_name(&self) -> String;

    /// Everything below the root. Links are not followed.
    ///
    /// # Errors
    /// Where the root itself cannot be listed.
    fn list(&self) -> Result<Listing, ReadError>;

    /// Opens a regular file, and gives its size in bytes.
    ///
    /// # Errors
    /// Where there is none, a link leads out of the root, or it cannot be read.
    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError>;

    /// The URDD of this folder name beside this one, where the source can have one.
    fn sibling(&self, _folder_name: &str) -> Option<Arc<dyn Source>> {
        None
    }

    /// The folder on disk, where files can be written.
    fn folder(&self) -> Option<&Path> {
        None
    }
}
