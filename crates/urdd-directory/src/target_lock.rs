//! Places that one run has for itself: a target, and a temporary folder.
//!
//! A run locks a file beside its place. The operating system releases the lock when the run ends, even after a crash.
//! So a run that gets the lock knows that no other run is active there, and removes what a killed one left.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs::{self, File, OpenOptions, TryLockError};
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use same_file::Handle;
use sha2::{Digest, Sha256};

use crate::cancellation::Cancellation;
use crate::file_type::STAGING_PREFIX;
use crate::unfinished::{Unfinished, What, writing};
use urdd_format::hexadecimal::hexadecimal;

/// Pause between attempts to get the lock.
const PAUSE: Duration = Duration::from_millis(20);

/// Exclusive access to a target, until dropped.
#[derive(Debug)]
pub struct TargetLock {
    path: PathBuf,
    /// Dropped after the file is removed, so that waiting runs notice that they waited for a removed file.
    _file: File,
    _unfinished: Unfinished,
}

impl TargetLock {
    /// Waits for exclusive access to `target`, whose parent folder must exist.
    ///
    /// # Errors
    /// [`io::ErrorKind::Interrupted`] if the wait was cancelled; or if the file system does not support locks, or the file
    /// cannot be created.
    pub fn acquire(target: &Path, cancellation: &Cancellation) -> io::Result<Self> {
        loop {
            if let Some(lock) = Self::at_once(target)? {
                return Ok(lock);
            }
            if cancellation.is_cancelled() {
                return Err(io::ErrorKind::Interrupted.into());
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
        let _writing = writing();
        loop {
            let file = open(&path)?;
            match file.try_lock() {
                Ok(()) if is_at(&file, &path) => {
                    let _unfinished = Unfinished::new(&path, What::Own);
                    return Ok(Some(TargetLock { path, _file: file, _unfinished }));
                }
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

/// A folder that is removed when this is dropped.
#[derive(Debug)]
pub struct Temporary {
    path: PathBuf,
    _unfinished: Unfinished,
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
        let lock = TargetLock::acquire(&path, &Cancellation::default())?;
        #[cfg_attr(not(unix), expect(unused_mut, reason = "only Unix has modes"))]
        let mut builder = fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        let _writing = writing();
        builder.create(&path)?;
        let _unfinished = Unfinished::new(&path, What::Own);
        Ok(Temporary { path, _unfinished, _lock: lock })
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
        let _writing = writing();
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
