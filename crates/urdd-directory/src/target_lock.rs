//! One run at a time into one place.
//!
//! Beside the place stands, while a run is at work, a file that the run holds locked. The operating
//! system lets go of the lock when the run ends, however it ends. So whoever gets it knows that no
//! other run is alive there.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use same_file::Handle;
use sha2::{Digest, Sha256};

use super::layout::STAGING_PREFIX;
use crate::cancellation::Cancellation;
use urdd_format::hexadecimal::hexadecimal;

/// How long to wait before the lock is tried again.
const PAUSE: Duration = Duration::from_millis(20);

/// The right to write at a place, until it is dropped.
#[derive(Debug)]
pub struct TargetLock {
    path: PathBuf,
    /// Dropped after the file's name is gone: who waits sees that it waited for another file.
    _file: File,
}

/// Why there is no lock.
#[derive(Debug)]
pub enum LockError {
    /// The caller was asked to stop while it waited.
    Cancelled,
    /// The file system has no locks, or the file cannot be made.
    Io(io::Error),
}

impl TargetLock {
    /// Waits for the right to write at `target`, whose folder is there.
    ///
    /// # Errors
    /// Where the wait was cancelled, or the file system cannot lock.
    pub fn acquire(target: &Path, cancellation: &Cancellation) -> Result<Self, LockError> {
        loop {
            if let Some(lock) = Self::at_once(target).map_err(LockError::Io)? {
                return Ok(lock);
            }
            if cancellation.is_cancelled() {
                return Err(LockError::Cancelled);
            }
            std::thread::sleep(PAUSE);
        }
    }

    /// The right to write at `target`; `None` while another run has it.
    ///
    /// # Errors
    /// Where the file system cannot lock.
    pub fn at_once(target: &Path) -> io::Result<Option<Self>> {
        let path = beside(target, ".lock");
        loop {
            let file = open(&path)?;
            match file.try_lock() {
                Ok(()) if is_at(&file, &path) => return Ok(Some(TargetLock { path, _file: file })),
                // The run before took the file away after this one opened it.
                Ok(()) => continue,
                Err(TryLockError::WouldBlock) => return Ok(None),
                Err(TryLockError::Error(error)) => {
                    let _ = fs::remove_file(&path);
                    return Err(error);
                }
            }
        }
    }
}

impl Drop for TargetLock {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.path);
    }
}

/// A path beside a place, of a name that is short, however long the place's name is.
pub(super) fn beside(target: &Path, ending: &str) -> PathBuf {
    let name = target.file_name().unwrap_or_default();
    let hash = Sha256::digest(name.as_encoded_bytes());
    let hash = hexadecimal(&hash[..8]);
    target.with_file_name(format!("{STAGING_PREFIX}{hash}{ending}"))
}

fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    options.open(path)
}

fn is_at(file: &File, path: &Path) -> bool {
    let here = file.try_clone().and_then(Handle::from_file);
    match (here, Handle::from_path(path)) {
        (Ok(here), Ok(there)) => here == there,
        _ => false,
    }
}
