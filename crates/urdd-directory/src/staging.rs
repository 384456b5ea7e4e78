//! Replaces a whole folder at once: writes it beside the target, then moves it into place with one rename.
//!
//! While a run is at work, two entries are beside the target. The folder `.urdd-<hash of the target's name>` contains
//! the new content. The run locks the file `.urdd-<hash>.lock` from before it reads the old content until the new
//! content is in place (see [`super::target_lock`]). A crashed run leaves both behind, and the old content in place.
//! The next run into the same target gets the lock, so no other run is active, and removes them. A second run waits for
//! the first.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use thiserror::Error;

#[path = "staging_among.rs"]
mod among;

use super::target_lock::{LockError, TargetLock, beside};
use crate::cancellation::Cancellation;

/// Why a folder could not be written. Its old content is unchanged.
#[derive(Debug, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum StagingError {
    #[error("{}: a folder cannot be written here: {reason}", path.display())]
    Place { path: PathBuf, reason: String },
    #[error("{}: cannot be written: {}", path.display(), in_words(error))]
    Write { path: PathBuf, error: io::Error },
    #[error("{}: cannot be read: {error}", path.display())]
    Read { path: PathBuf, error: io::Error },
    #[error("{}: this file does not belong to the URDD, and would be overwritten; move it away", path.display())]
    InTheWay { path: PathBuf },
    #[error("{}: this is a link, and nothing is written through it; replace it by the folder that it leads to", path.display())]
    Link { path: PathBuf },
    #[error("stopped before it was finished; nothing was changed")]
    Cancelled,
    #[error(
        "{}: this folder is not empty, and is not a URDD that `urdd generate` wrote; give another folder, or --force to write there (files with other names stay)", path.display()
    )]
    Occupied { path: PathBuf },
}

fn in_words(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            format!("the disk is full ({error}); nothing was changed")
        }
        _ => error.to_string(),
    }
}

/// A folder in preparation.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    /// The working folder beside the target.
    workplace: PathBuf,
    /// The new content, inside the working folder.
    content: PathBuf,
    /// Whether to replace the contents of the target and keep the folder itself.
    is_inside: bool,
    /// Released last. `None` where the file system does not support locks.
    _lock: Option<TargetLock>,
}

const OLD: &str = "old";

impl Staging {
    /// Waits until no other run writes to `target`, removes what a crashed run left there, and creates the working
    /// folder beside it. `target` is unchanged until [`Staging::commit`].
    ///
    /// # Errors
    /// If `target` is a file, the current folder or one above it, if its parent folder is not writable, or if the wait
    /// was cancelled.
    pub fn begin(target: &Path, cancellation: &Cancellation) -> Result<Self, StagingError> {
        let target = place(target)?;
        if holds_current(&target) {
            let reason = "it is the current folder, or above it; run the command from elsewhere";
            return Err(StagingError::Place { path: target, reason: reason.to_owned() });
        }
        Self::at(target, false, cancellation)
    }

    /// As [`Staging::begin`], but also for the current folder or one above it. Replacing that folder itself would leave
    /// other processes in a deleted folder, so [`Staging::commit`] replaces its changed files one by one (`staging_among.rs`).
    ///
    /// # Errors
    /// As [`Staging::begin`].
    pub fn begin_inside(target: &Path, cancellation: &Cancellation) -> Result<Self, StagingError> {
        let target = place(target)?;
        let is_inside = holds_current(&target);
        Self::at(target, is_inside, cancellation)
    }

    /// As [`Staging::begin`], for files beside `anchor`, whose folder exists and stays: see `staging_among.rs`.
    pub(super) fn begin_among(anchor: &Path) -> Result<Self, StagingError> {
        let write = |error| StagingError::Write { path: anchor.to_owned(), error };
        let folder = parent(anchor).canonicalize().map_err(write)?;
        let anchor = folder.join(anchor.file_name().unwrap_or_default());
        Self::at(anchor, false, &Cancellation::default())
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
            // Without a lock, other runs may be active: use a separate folder, and remove nothing.
            None => beside(&target, &format!("-{}", std::process::id())),
        };
        if lock.is_some() {
            rescue(&workplace, &target);
            remove(&workplace);
        }
        let content = workplace.join(among::CONTENT);
        let made = fs::create_dir(&workplace).and_then(|()| fs::create_dir(&content));
        let staging = Staging { target, workplace, content, is_inside, _lock: lock };
        match made {
            Ok(()) => Ok(staging),
            Err(error) => {
                let path = staging.target.clone();
                Err(StagingError::Write { path, error })
            }
        }
    }

    /// Moves prepared files into `folder`, one by one: see `staging_among.rs`.
    ///
    /// # Errors
    /// The file that cannot be moved, and why. The folder is as before then.
    pub(super) fn put_among<'p>(
        &self,
        folder: &Path,
        paths: &[&'p Path],
    ) -> Result<(), (&'p Path, io::Error)> {
        among::put(&self.workplace, folder, paths)
    }

    /// The folder for the new content.
    pub fn content(&self) -> &Path {
        &self.content
    }

    /// The final path of the content.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Moves the new content into place, with the permissions of the folders and files it replaces. Atomic on Linux and
    /// macOS if the file system can exchange folders. Else the target is missing for a moment between two renames.
    ///
    /// # Errors
    /// If it cannot be renamed. The old content is then in place.
    pub fn commit(self) -> Result<(), StagingError> {
        keep_modes(&self.target, &self.content)
            .and_then(|()| match self.is_inside {
                true => among::put_changed(&self.workplace, &self.target),
                false => put(&self.content, &self.target, &self.workplace.join(OLD)),
            })
            .map_err(|error| StagingError::Write { path: self.target.clone(), error })
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        // If the old content cannot be restored, keep it for the next run to restore.
        if rescue(&self.workplace, &self.target) {
            remove(&self.workplace);
        }
    }
}

/// The target as a path that `rename` accepts.
fn place(target: &Path) -> Result<PathBuf, StagingError> {
    let refuse = |reason: &str| {
        Err(StagingError::Place { path: target.to_owned(), reason: reason.to_owned() })
    };
    let write = |error| StagingError::Write { path: target.to_owned(), error };
    if let Ok(metadata) = fs::metadata(target) {
        if !metadata.is_dir() {
            return refuse("a file of that name exists");
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

/// Restores the old content if a run ended between two renames, or completes it. `false` if the former fails.
fn rescue(workplace: &Path, target: &Path) -> bool {
    let old = workplace.join(OLD);
    let is_folder = |path: &Path| fs::symlink_metadata(path).is_ok_and(|there| there.is_dir());
    // Links in their places are not ours.
    if !is_folder(workplace) || old.is_symlink() {
        return true;
    }
    among::complete(workplace, &parent(target));
    let is_gone = fs::symlink_metadata(target).is_err();
    match is_gone && old.is_dir() {
        true => fs::rename(&old, target).is_ok(),
        false => true,
    }
}

/// Removes a folder, including read-only folders in it.
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

/// Gives each new folder and file the permissions of the one it replaces.
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
    // The folder last: it may become read-only.
    match before.permissions() == after.permissions() {
        true => Ok(()),
        false => fs::set_permissions(new, before.permissions()),
    }
}

fn put(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
    // Succeeds if the target is missing, or (on Unix) an empty folder.
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

/// Exchanges two folders atomically. `false` if unsupported.
#[cfg(any(target_os = "linux", target_os = "macos"))]
fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
        Ok(()) => Ok(true),
        // Not supported by every file system.
        Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(any(target_os = "linux", target_os = "macos")))]
fn exchange(_: &Path, _: &Path) -> io::Result<bool> {
    Ok(false)
}
