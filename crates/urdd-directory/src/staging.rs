//! Writing a whole folder at once: it is made beside its place and put there by one rename.
//!
//! Beside the target stands, while it is written, a folder `.urdd-<hash of the target's name>` with
//! the new content in it, and a file `.urdd-<hash>.lock`, which the run holds locked from the first
//! look at the old content until the new one is in its place (see [`super::target_lock`]). A run that
//! dies leaves both behind, and the old content in its place; the next run into the same target gets
//! the lock, so nobody else is at work there, and takes them away. A second run waits for the first.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use thiserror::Error;

#[path = "staging_inside.rs"]
mod inside;

use super::target_lock::{LockError, TargetLock, beside};
use crate::cancellation::Cancellation;

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
    /// A file that is not the URDD's is in the place of one that is.
    #[error("{}: this file is not of the URDD, and would be overwritten; move it away", path.display())]
    InTheWay {
        /// The file.
        path: PathBuf,
    },
    /// It was asked to stop.
    #[error("stopped before it was done; nothing was changed")]
    Cancelled,
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
    /// Whether the folder itself stays, and what is in it is replaced.
    is_inside: bool,
    /// Let go last. There is none where the file system cannot lock.
    _lock: Option<TargetLock>,
}

const CONTENT: &str = "new";
const OLD: &str = "old";

impl Staging {
    /// Waits until no other run writes at `target`, takes away what a dead run left there, and makes
    /// the folder beside it. What stands at `target` stays as it is until [`Staging::commit`].
    ///
    /// # Errors
    /// Where `target` is a file, the current folder or one above it, or cannot be written beside,
    /// and where the wait was cancelled.
    pub fn begin(target: &Path, cancellation: &Cancellation) -> Result<Self, StagingError> {
        let target = place(target)?;
        if holds_current(&target) {
            let reason = "it is the current folder, or above it; run the command from elsewhere";
            return Err(StagingError::Place {
                path: target,
                reason: reason.to_owned(),
            });
        }
        Self::at(target, false, cancellation)
    }

    /// As [`Staging::begin`], for a folder that may be the current one, or above it: whoever is at work in such a folder
    /// would stand in one that is gone if another took its place. Then [`Staging::commit`] replaces what is in it, entry
    /// by entry: each at once, and all or none of them as long as the program runs.
    ///
    /// # Errors
    /// As [`Staging::begin`].
    pub fn begin_inside(target: &Path, cancellation: &Cancellation) -> Result<Self, StagingError> {
        let target = place(target)?;
        let is_inside = holds_current(&target);
        Self::at(target, is_inside, cancellation)
    }

    fn at(
        target: PathBuf,
        is_inside: bool,
        cancellation: &Cancellation,
    ) -> Result<Self, StagingError> {
        let lock = match TargetLock::acquire(&target, cancellation) {
            Ok(lock) => Some(lock),
            Err(LockError::Cancelled) => return Err(StagingError::Cancelled),
            Err(LockError::Io(error)) if error.kind() == ErrorKind::Unsupported => None,
            Err(LockError::Io(error)) => {
                let path = target;
                return Err(StagingError::Write { path, error });
            }
        };
        let workplace = match lock {
            Some(_) => beside(&target, ""),
            // Others may be at work: a folder of this run's own, and nothing is taken away.
            None => beside(&target, &format!("-{}", std::process::id())),
        };
        if lock.is_some() {
            rescue(&workplace, &target);
            remove(&workplace);
        }
        let content = workplace.join(CONTENT);
        let made = fs::create_dir(&workplace).and_then(|()| fs::create_dir(&content));
        let staging = Staging {
            target,
            workplace,
            content,
            is_inside,
            _lock: lock,
        };
        match made {
            Ok(()) => Ok(staging),
            Err(error) => {
                let path = staging.target.clone();
                Err(StagingError::Write { path, error })
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

    /// Puts the new content in its place, with the modes of the folders that were there. On Linux
    /// and macOS there is no moment without the one or the other; elsewhere there is, between two
    /// renames.
    ///
    /// # Errors
    /// Where it cannot be renamed; then the old content is in its place.
    pub fn commit(self) -> Result<(), StagingError> {
        keep_modes(&self.target, &self.content)
            .and_then(|()| {
                let old = self.workplace.join(OLD);
                match self.is_inside {
                    true => inside::put(&self.content, &self.target, &old),
                    false => put(&self.content, &self.target, &old),
                }
            })
            .map_err(|error| StagingError::Write {
                path: self.target.clone(),
                error,
            })
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // Where the only copy cannot be put back, it stays for the next run to put back.
        if rescue(&self.workplace, &self.target) {
            remove(&self.workplace);
        }
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

fn holds_current(target: &Path) -> bool {
    std::env::current_dir().is_ok_and(|current| current.starts_with(target))
}

fn parent(target: &Path) -> PathBuf {
    match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Puts the old content back where a run ended between two renames. `false` where that is needed
/// and cannot be done.
fn rescue(workplace: &Path, target: &Path) -> bool {
    let old = workplace.join(OLD);
    let is_gone = fs::symlink_metadata(target).is_err();
    match is_gone && old.is_dir() {
        true => fs::rename(&old, target).is_ok(),
        false => inside::put_back(&old, target).is_ok(),
    }
}

/// Takes a folder away, read-only folders in it too.
fn remove(folder: &Path) {
    if fs::remove_dir_all(folder).is_err() {
        make_writable(folder);
        let _ = fs::remove_dir_all(folder);
    }
}

fn make_writable(folder: &Path) {
    let Ok(metadata) = fs::symlink_metadata(folder) else {
        return;
    };
    if !metadata.is_dir() {
        return;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = metadata.permissions().mode() | 0o700;
        let _ = fs::set_permissions(folder, fs::Permissions::from_mode(mode));
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        make_writable(&entry.path());
    }
}

/// Gives each folder and file of the new content the mode of what it takes the place of.
fn keep_modes(old: &Path, new: &Path) -> io::Result<()> {
    let Ok(before) = fs::symlink_metadata(old) else {
        return Ok(());
    };
    let after = fs::symlink_metadata(new)?;
    if before.file_type() != after.file_type() || after.is_symlink() {
        return Ok(());
    }
    if after.is_dir() {
        for entry in fs::read_dir(new)? {
            let name = entry?.file_name();
            keep_modes(&old.join(&name), &new.join(&name))?;
        }
    }
    // The folder last: it may be read-only.
    match before.permissions() == after.permissions() {
        true => Ok(()),
        false => fs::set_permissions(new, before.permissions()),
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
