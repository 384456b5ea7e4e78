//! Allows one run at a time per target.
//!
//! A run locks a file beside the target. The operating system releases the lock when the run ends, even after a crash.
//! So a run that gets the lock knows that no other run is active there.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use same_file::Handle;
use sha2::{Digest, Sha256};

use super::layout::STAGING_PREFIX;
use crate::cancellation::Cancellation;
use urdd_format::hexadecimal::hexadecimal;

/// Pause between attempts to get the lock.
const PAUSE: Duration = Duration::from_millis(20);

/// Exclusive access to a target, until dropped.
#[derive(Debug)]
pub struct TargetLock {
    path: PathBuf,
    /// Dropped after the file is removed, so that waiting runs notice that they waited for a removed file.
    _file: File,
}

/// Why the lock was not acquired.
#[derive(Debug)]
pub enum LockError {
    /// The wait was cancelled.
    Cancelled,
    /// The file system does not support locks, or the file cannot be created.
    Io(io::Error),
}

impl TargetLock {
    /// Waits for exclusive access to `target`, whose parent folder must exist.
    ///
    /// # Errors
    /// If the wait was cancelled, or the file system does not support locks.
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

    /// Whether there is a lock file for `target`: of a run that is active, or that was killed.
    pub fn is_left(target: &Path) -> bool {
        beside(target, ".lock").is_file()
    }

    /// Acquires exclusive access to `target` without waiting; `None` while another run has it.
    ///
    /// # Errors
    /// If the file system does not support locks.
    pub fn at_once(target: &Path) -> io::Result<Option<Self>> {
        let path = beside(target, ".lock");
        loop {
            let file = open(&path)?;
            match file.try_lock() {
                Ok(()) if is_at(&file, &path) => return Ok(Some(TargetLock { path, _file: file })),
                // The previous run removed the file after this one opened it.
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

/// A path beside the target with a short name, regardless of the length of the target's name.
pub(super) fn beside(target: &Path, ending: &str) -> PathBuf {
    let name = target.file_name().unwrap_or_default();
    let hash = Sha256::digest(name.as_encoded_bytes());
    let hash = hexadecimal(&hash[..8]);
    target.with_file_name(format!("{STAGING_PREFIX}{hash}{ending}"))
}

fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.read(true).write(true).create(true).truncate(false);
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.custom_flags(rustix::fs::OFlags::NOFOLLOW.bits().cast_signed());
    }
    options.open(path)
}

fn is_at(file: &File, path: &Path) -> bool {
    let here = file.try_clone().and_then(Handle::from_file);
    match (here, Handle::from_path(path)) {
        (Ok(here), Ok(there)) => here == there,
        _ => false,
    }
}
