//! Writing a whole folder at once: it is made beside its place and put there by one rename.
//!
//! Beside the target `x` stands, while it is written, a folder `.x.urdd-<process>-<number>`, with
//! the new content in it and a file `lock`, which the writing process holds locked. A run that dies
//! leaves that folder behind, and the old content in its place; the next run into the same target
//! sees that nobody holds the lock, and takes the left-over away. Two runs at one time have a
//! folder each, and the last to finish stays.

use std::fs::{self, File, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use thiserror::Error;

/// Why a folder could not be written. What stood in its place still does.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StagingError {
    /// The target cannot be a folder's place.
    #[error("{}: a folder cannot be written here: {reason}", path.display())]
    Place {
        /// The target.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A file or folder cannot be written.
    #[error("{}: cannot be written: {}", path.display(), in_words(error))]
    Write {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        error: io::Error,
    },
    /// A file that is to be copied cannot be read.
    #[error("{}: cannot be read: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        error: io::Error,
    },
    /// The target holds something else.
    #[error(
        "{}: this folder is not empty, and no URDD that `urdd generate` wrote; give another one, or --force to write there (files of other names stay)", path.display()
    )]
    Occupied {
        /// The target.
        path: PathBuf,
    },
}

fn in_words(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            format!("the disk is full ({error}); nothing was changed")
        }
        _ => error.to_string(),
    }
}

/// A folder that is being written.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    /// The folder beside the target.
    workplace: PathBuf,
    /// The new content, in it.
    content: PathBuf,
    lock: Option<File>,
}

const LOCK: &str = "lock";
const CONTENT: &str = "new";
const OLD: &str = "old";

impl Staging {
    /// Makes the folder beside `target`, and takes away what dead runs left there.
    ///
    /// # Errors
    /// Where `target` is a file, the current folder or one above it, or cannot be written beside.
    pub fn begin(target: &Path) -> Result<Self, StagingError> {
        let target = place(target)?;
        let parent = parent(&target);
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let prefix = format!(".{name}.urdd-");
        clean(&parent, &prefix);
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let process = std::process::id();
        loop {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let workplace = parent.join(format!("{prefix}{process}-{number}"));
            match make(&workplace) {
                Ok(lock) => {
                    return Ok(Staging {
                        content: workplace.join(CONTENT),
                        lock: Some(lock),
                        target,
                        workplace,
                    });
                }
                // Another's, or one that was cleaned away before its lock was held.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
                Err(error) if error.kind() == ErrorKind::NotFound && parent.is_dir() => {}
                Err(error) => {
                    let path = target;
                    return Err(StagingError::Write { path, error });
                }
            }
        }
    }

    /// Where the new content is to be written.
    pub fn content(&self) -> &Path {
        &self.content
    }

    /// Where the content will be.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Puts the new content in its place. On Linux and macOS there is no moment without the one or
    /// the other; elsewhere there is, between two renames.
    ///
    /// # Errors
    /// Where it cannot be renamed; then the old content is in its place.
    pub fn commit(self) -> Result<(), StagingError> {
        put(&self.content, &self.target, &self.workplace.join(OLD)).map_err(|error| {
            StagingError::Write {
                path: self.target.clone(),
                error,
            }
        })
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        let old = self.workplace.join(OLD);
        let is_gone = fs::symlink_metadata(&self.target).is_err();
        if is_gone && old.is_dir() && fs::rename(&old, &self.target).is_err() {
            // The only copy is here: it stays, for the next run to put back.
            return;
        }
        let _ = fs::remove_dir_all(&self.content);
        let _ = fs::remove_dir_all(old);
        // Let go only now: whoever finds the folder without its lock takes it away.
        drop(self.lock.take());
        let _ = fs::remove_dir_all(&self.workplace);
    }
}

/// The target as a path that renaming works on.
fn place(target: &Path) -> Result<PathBuf, StagingError> {
    let refuse = |reason: &str| {
        Err(StagingError::Place {
            path: target.to_owned(),
            reason: reason.to_owned(),
        })
    };
    let write = |error| StagingError::Write {
        path: target.to_owned(),
        error,
    };
    if let Ok(metadata) = fs::metadata(target) {
        if !metadata.is_dir() {
            return refuse("there is a file of that name");
        }
        let canonical = target.canonicalize().map_err(write)?;
        if std::env::current_dir().is_ok_and(|current| current.starts_with(&canonical)) {
            return refuse("it is the current folder, or above it; run the command from elsewhere");
        }
        if canonical.parent().is_none() {
            return refuse("it is the root of the file system");
        }
        return Ok(canonical);
    }
    let Some(name) = target.file_name() else {
        return refuse("the path does not end with a name");
    };
    let parent = parent(target);
    fs::create_dir_all(&parent).map_err(write)?;
    Ok(parent.canonicalize().map_err(write)?.join(name))
}

fn parent(target: &Path) -> PathBuf {
    match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn make(workplace: &Path) -> io::Result<File> {
    fs::create_dir(workplace)?;
    let lock = File::create_new(workplace.join(LOCK))?;
    match lock.try_lock() {
        Ok(()) | Err(TryLockError::Error(_)) => {}
        Err(TryLockError::WouldBlock) => return Err(ErrorKind::NotFound.into()),
    }
    fs::create_dir(workplace.join(CONTENT))?;
    Ok(lock)
}

/// Takes away the folders of runs that are no more.
fn clean(parent: &Path, prefix: &str) {
    let Ok(entries) = fs::read_dir(parent) else {
        return;
    };
    for entry in entries.flatten() {
        let is_ours = entry.file_name().to_string_lossy().starts_with(prefix);
        if !is_ours || !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            continue;
        }
        match File::open(entry.path().join(LOCK)) {
            Ok(lock) if lock.try_lock().is_ok() => {
                rescue(&entry.path(), parent, prefix);
                let _ = fs::remove_dir_all(entry.path());
            }
            Ok(_) => {}
            // Just made, or hardly begun: goes only while there is nothing in it.
            Err(_) => {
                let _ = fs::remove_dir(entry.path());
            }
        }
    }
}

/// Puts the old content back where a run died between two renames.
fn rescue(workplace: &Path, parent: &Path, prefix: &str) {
    let name = prefix
        .strip_prefix('.')
        .and_then(|name| name.strip_suffix(".urdd-"));
    if let Some(name) = name
        && fs::symlink_metadata(parent.join(name)).is_err()
    {
        let _ = fs::rename(workplace.join(OLD), parent.join(name));
    }
}

fn put(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
    // Onto nothing, or (on Unix) an empty folder.
    let error = match fs::rename(content, target) {
        Ok(()) => return Ok(()),
        Err(error) => error,
    };
    if !target.is_dir() {
        return Err(error);
    }
    if exchange(content, target)? {
        return Ok(());
    }
    fs::rename(target, old)?;
    fs::rename(content, target).inspect_err(|_| {
        let _ = fs::rename(old, target);
    })
}

/// Exchanges two folders at once; `false` where that cannot be done here.
#[cfg(any(target_os = "linux", target_os = "macos"))]
fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
        Ok(()) => Ok(true),
        // Not every file system can.
        Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(any(target_os = "linux", target_os = "macos")))]
fn exchange(_: &Path, _: &Path) -> io::Result<bool> {
    Ok(false)
}
