//! A folder that is removed when the program ends. The next run removes what a killed program left: a process that
//! obtains a folder's lock knows that no other process uses it.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::target_lock::{LockError, TargetLock};
use crate::cancellation::Cancellation;

/// A folder that is removed when this is dropped.
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
    /// Released after the folder is removed.
    _lock: TargetLock,
}

impl Temporary {
    /// Creates a folder that only this user can access in `place`, with `purpose` in its name, and removes those of
    /// programs that have ended.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn begin(place: &Path, purpose: &str) -> io::Result<Self> {
        let prefix = format!("urdd-{purpose}-");
        take_away(place, &prefix);
        // Each has other keys.
        let random = RandomState::new().hash_one(());
        let path = place.join(format!("{prefix}{random:016x}"));
        // Locks before the folder exists: other processes remove unlocked folders.
        let lock = TargetLock::acquire(&path, &Cancellation::default());
        let lock = lock.map_err(|error| match error {
            LockError::Io(error) => error,
            LockError::Cancelled => io::ErrorKind::Interrupted.into(),
        })?;
        #[cfg_attr(not(unix), expect(unused_mut, reason = "only Unix has modes"))]
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&path)?;
        Ok(Temporary { path, _lock: lock })
    }

    /// Writes a file that only this user can read.
    ///
    /// # Errors
    /// If it cannot be written, or is there.
    pub fn private(&self, name: &str, text: &str) -> io::Result<PathBuf> {
        let path = self.path.join(name);
        let mut options = fs::OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        options.open(&path)?.write_all(text.as_bytes())?;
        Ok(path)
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.path);
    }
}

/// Removes the folders of programs that have ended: those with a name that [`Temporary::begin`] gives, and with the lock
/// file that a killed program leaves. Those of other users remain: they cannot be locked or removed.
fn take_away(place: &Path, prefix: &str) {
    for entry in fs::read_dir(place).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let number = name.to_str().and_then(|name| name.strip_prefix(prefix)).unwrap_or_default();
        let is_ours = number.len() == 16
            && number.bytes().all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f'))
            && entry.file_type().is_ok_and(|kind| kind.is_dir())
            && TargetLock::is_left(&path);
        if is_ours && let Ok(Some(_lock)) = TargetLock::at_once(&path) {
            let _ = fs::remove_dir_all(path);
        }
    }
}
