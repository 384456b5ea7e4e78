//! Limits: on what is read, since a URDD is untrusted (SPEC 13.1), and on what may be made of it.
//!
//! Whoever reads a stranger's file keeps an [`Account`]: each file that is read adds to it, and whatever is made of it
//! (elements, names, pairs, vertices, text) is charged, in bytes of memory. So an answer takes at most
//! [`MULTIPLE`] times what was read and [`ALLOWANCE`] bytes, whatever a small file asks for. Work without a result,
//! such as reading the same file again, is charged too, a byte for some nanoseconds: time has the same bound.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use thiserror::Error;

/// Largest document, bytes.
pub const MAX_DOCUMENT_BYTES: u64 = 512 << 20;

/// Largest URDF, bytes: of a source, and in a URDD.
pub const MAX_URDF_BYTES: u64 = 64 << 20;

/// Maximum number of files and folders listed in one URDD.
pub const MAX_FILES: usize = 100_000;

/// Maximum number of files around a description that are not on the disk.
pub const MAX_SET_FILES: usize = 20_000;

/// Largest total size of these files, bytes.
pub const MAX_SET_BYTES: u64 = 2 << 30;

/// Deepest folder below a URDD's root, and below a searched folder.
pub const MAX_FOLDER_DEPTH: usize = 32;

/// Maximum nesting depth of objects and lists in JSON and YAML.
pub const DEPTH_LIMIT: usize = 100;

/// Largest zip archive, bytes.
pub const MAX_ARCHIVE_BYTES: u64 = 1 << 30;

/// Largest total inflated size of a zip archive, bytes.
pub const MAX_INFLATED_BYTES: u64 = 4 << 30;

/// Largest ratio of total inflated size to archive size, above [`SMALL_ARCHIVE_BYTES`]. Modules with long lists of
/// zeros reach about 200.
pub const MAX_INFLATION: u64 = 250;

/// Inflated size that is allowed regardless of archive size, bytes.
pub const SMALL_ARCHIVE_BYTES: u64 = 64 << 20;

/// Largest file that is given to a browser or copied for one, bytes.
pub const MAX_FILE_BYTES: u64 = 1 << 30;

/// Longest name of an entry in a zip archive, bytes: the path limit of Linux.
pub const MAX_NAME_BYTES: usize = 4096;

/// Longest part of such a name between slashes, bytes: 255 characters of up to four bytes, the limit of file systems.
pub const MAX_PART_BYTES: usize = 1020;

/// Largest `VERSION` file of a module, bytes.
pub const MAX_VERSION_BYTES: u64 = 1024;

/// Largest TOML file, bytes: `NAME.export.toml`, a recipe, `urdd.toml`.
pub const MAX_TOML_BYTES: u64 = 1 << 20;

/// Largest file that says what a package or a model has, bytes: `package.xml`, `model.config`, `CMakeLists.txt`,
/// `setup.py`, a launch file.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// Largest SRDF, and largest xacro file that is searched for names, bytes.
pub const MAX_SRDF_BYTES: u64 = 16 << 20;

/// The most of a list of spheres, bytes.
pub const MAX_SPHERES_BYTES: u64 = 16 << 20;

/// Bytes that may be made of any input.
pub const ALLOWANCE: u64 = 128 << 20;

/// Bytes that may be made of each byte that was read. Ordinary descriptions use a tenth.
pub const MULTIPLE: u64 = 100;

/// The account of one run on one description. Clones share it.
#[derive(Debug, Clone, Default)]
pub struct Account(Arc<Sums>);

#[derive(Debug, Default)]
struct Sums {
    read: AtomicU64,
    spent: AtomicU64,
}

/// More would be made than [`Account`] allows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "more would be made of the description than {MULTIPLE} times its size and {} MiB; shorten what is repeated: names, replicas, configurations, or uses of one file", ALLOWANCE >> 20
)]
pub struct Overdrawn;

impl Account {
    /// Adds a file that was read, by its size in bytes. A file that is read twice is added once.
    pub fn deposit(&self, bytes: usize) {
        add(&self.0.read, bytes);
    }

    /// Charges what is about to be made, in bytes.
    ///
    /// # Errors
    /// If the account does not have them. They are not to be made then.
    pub fn charge(&self, bytes: usize) -> Result<(), Overdrawn> {
        let spent = add(&self.0.spent, bytes);
        let most = self.0.read.load(Ordering::Relaxed).saturating_mul(MULTIPLE);
        if spent > most.saturating_add(ALLOWANCE) { Err(Overdrawn) } else { Ok(()) }
    }
}

/// The new sum, which never wraps.
fn add(sum: &AtomicU64, bytes: usize) -> u64 {
    let added = |sum: u64| sum.saturating_add(bytes as u64);
    let old = sum.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |sum| Some(added(sum)));
    added(old.unwrap_or_else(|sum| sum))
}

/// A list whose entries were charged: there is no other way to add one.
#[derive(Debug, Clone, PartialEq)]
pub struct Charged<T>(Vec<T>);

/// The bytes of an entry, with its texts, as they are charged.
pub trait Cost {
    /// In bytes.
    fn cost(&self) -> usize;
}

impl<T> Default for Charged<T> {
    fn default() -> Self {
        Charged(Vec::new())
    }
}

impl<T: Cost> Charged<T> {
    /// Adds an entry, if the account has its cost.
    ///
    /// # Errors
    /// If it does not.
    pub fn push(&mut self, entry: T, account: &Account) -> Result<(), Overdrawn> {
        account.charge(entry.cost())?;
        self.0.push(entry);
        Ok(())
    }
}

impl<T> std::ops::Deref for Charged<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> std::ops::DerefMut for Charged<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.0
    }
}

impl<'a, T> IntoIterator for &'a Charged<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
