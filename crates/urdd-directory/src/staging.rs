//! Replaces a whole folder at once: writes it beside the target, then moves it into place with one rename.
//!
//! While a run is at work, two entries are beside the target. The folder `.urdd-<hash of the target's name>` contains
//! the new content. The run locks the file `.urdd-<hash>.lock` from before it reads the old content until the new
//! content is in place (see [`crate::target_lock`]). A crashed run leaves both behind, and the old content in place.
//! The next run into the same target gets the lock, so no other run is active, and removes them. A second run waits for
//! the first.
//!
//! Where a folder has other files too, the new ones are moved into it one by one. The files that will be replaced are
//! copied to `was`. Then the new files become `ready`, which decides: if the run is killed from then on, the next run into
//! the same place moves what is left in `ready`, and leaves alone what somebody changed in between.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use same_file::is_same_file;

use crate::cancellation::Cancellation;
use crate::file_type::ROOT_METADATA;
pub use crate::take::StagingError;
use crate::take::{keep_modes, remove};
use crate::target_lock::{TargetLock, beside};
use crate::unfinished::{Unfinished, What, writing};
use crate::{file_entry, regular};

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
    _unfinished: Unfinished,
    /// Released last. `None` where the file system does not support locks.
    _lock: Option<TargetLock>,
}

/// What is in the working folder: the prepared files, those of them that are moved one by one, copies of the files that
/// these replace, and the old folder.
const CONTENT: &str = "new";
const READY: &str = "ready";
const WAS: &str = "was";
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
    /// other processes in a deleted folder, so [`Staging::commit`] replaces its changed files one by one.
    ///
    /// # Errors
    /// As [`Staging::begin`].
    pub fn begin_inside(target: &Path, cancellation: &Cancellation) -> Result<Self, StagingError> {
        let target = place(target)?;
        let is_inside = holds_current(&target);
        Self::at(target, is_inside, cancellation)
    }

    /// As [`Staging::begin`], for files beside `anchor`, whose folder exists and stays.
    pub(super) fn begin_among(anchor: &Path) -> Result<Self, StagingError> {
        let folder = parent(anchor).canonicalize().map_err(StagingError::write(anchor))?;
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
            Err(error) if error.kind() == ErrorKind::Interrupted => {
                return Err(StagingError::Cancelled);
            }
            Err(error) if error.kind() == ErrorKind::Unsupported => None,
            Err(error) => return Err(StagingError::write(&target)(error)),
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
        let content = workplace.join(CONTENT);
        let _writing = writing();
        let _unfinished = Unfinished::new(&workplace, What::Own);
        let staging = Staging { target, workplace, content, is_inside, _unfinished, _lock: lock };
        fs::create_dir(&staging.workplace)
            .and_then(|()| fs::create_dir(&staging.content))
            .map_err(StagingError::write(&staging.target))?;
        Ok(staging)
    }

    /// Moves prepared files into a folder that has other files too, one by one, in this order. A new folder moves as a
    /// whole.
    ///
    /// # Errors
    /// The file that cannot be moved, and why. The folder is as before then.
    pub(super) fn put_among<'p>(
        &self,
        folder: &Path,
        paths: &[&'p Path],
    ) -> Result<(), (&'p Path, io::Error)> {
        let _writing = writing();
        let content = &self.content;
        let [ready, was] = [READY, WAS].map(|name| self.workplace.join(name));
        for path in paths {
            keep(folder, content, &was, path).map_err(|error| (*path, error))?;
        }
        let mut known = BTreeSet::new();
        let parts = paths.iter().map(|path| new_part(folder, path));
        let parts: Vec<&Path> = parts.filter(|part| known.insert(*part)).collect();
        if let [part, _, ..] = parts.as_slice() {
            fs::rename(content, &ready).map_err(|error| (*part, error))?;
        }
        let from = if parts.len() > 1 { &ready } else { content };
        let place = |part: &&'p Path| (*part, from.join(part), folder.join(part));
        let moves: Vec<_> = parts.iter().map(place).collect();
        // A kill between two of these is what the next run has to complete: nothing else is done here.
        for (number, (part, from, to)) in moves.iter().enumerate() {
            if let Err(error) = fs::rename(from, to) {
                for (part, _, place) in &moves[..number] {
                    let _ = fs::rename(was.join(part), place)
                        .or_else(|_| fs::remove_file(place))
                        .or_else(|_| fs::remove_dir_all(place));
                }
                let _ = fs::rename(&ready, content);
                return Err((part, error));
            }
        }
        Ok(())
    }

    /// Moves the files that differ from those of the target, `urdd.json` last: until then, the hashes show that the folder
    /// is incomplete.
    fn put_changed(&self) -> io::Result<()> {
        let (content, target) = (&self.content, &self.target);
        let mut paths = Vec::new();
        files(content, Path::new(""), &mut paths)?;
        paths.retain(|path| !is_same_file(content.join(path), target.join(path)).unwrap_or(false));
        paths.sort_by_key(|path| path.as_os_str() == ROOT_METADATA);
        let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
        self.put_among(target, &paths).map_err(|(_, error)| error)
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
        let _writing = writing();
        let done = keep_modes(&self.target, &self.content)
            .and_then(|()| match self.is_inside {
                true => self.put_changed(),
                false => put(&self.content, &self.target, &self.workplace.join(OLD)),
            })
            .map_err(StagingError::write(&self.target));
        // What is left of the old content goes, or comes back, while nothing is removed from outside.
        drop(self);
        done
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
    let write = StagingError::write(target);
    if let Ok(metadata) = fs::metadata(target) {
        if !metadata.is_dir() {
            return refuse("a file of that name exists");
        }
        let canonical = target.canonicalize().map_err(&write)?;
        if canonical.parent().is_none() {
            return refuse("it is the root of the file system");
        }
        return Ok(canonical);
    }
    let Some(name) = target.file_name() else {
        return refuse("the path does not end with a name");
    };
    let parent = parent(target);
    fs::create_dir_all(&parent).map_err(&write)?;
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
    complete(workplace, &parent(target));
    let is_gone = fs::symlink_metadata(target).is_err();
    match is_gone && old.is_dir() {
        true => fs::rename(&old, target).is_ok(),
        false => true,
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

/// Copies the file that will be replaced, and gives the new one its permissions.
fn keep(folder: &Path, new: &Path, was: &Path, path: &Path) -> io::Result<()> {
    let (place, copy) = (folder.join(path), was.join(path));
    let Ok(there) = fs::metadata(&place) else {
        return Ok(());
    };
    copy.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::copy(&place, &copy)?;
    fs::set_permissions(new.join(path), there.permissions())
}

/// The outermost folder on the way to a file that is new, or the file.
fn new_part<'p>(folder: &Path, path: &'p Path) -> &'p Path {
    let is_new = |part: &&Path| fs::symlink_metadata(folder.join(part)).is_err();
    let parts: Vec<&Path> = path.ancestors().collect();
    parts.into_iter().rev().find(is_new).unwrap_or(path)
}

/// Moves what a killed run did not, where everything is as that run found it.
fn complete(workplace: &Path, folder: &Path) {
    let (ready, was) = (workplace.join(READY), workplace.join(WAS));
    let hash = |path: &Path| file_entry::of_reader(regular::open(path).ok()?).ok();
    let mut left = Vec::new();
    if files(&ready, Path::new(""), &mut left).is_err() {
        return;
    }
    for path in left {
        let (place, before) = (folder.join(&path), was.join(&path));
        let is_there = |path: &Path| fs::symlink_metadata(path).is_ok();
        let is_as_before = match is_there(&place) {
            true => hash(&before).is_some() && hash(&before) == hash(&place),
            false => !is_there(&before),
        };
        let is_linked = path.ancestors().any(|part| folder.join(part).is_symlink());
        if is_as_before
            && !is_linked
            && let Some(above) = place.parent()
        {
            let _ = fs::create_dir_all(above).and_then(|()| fs::rename(ready.join(&path), &place));
        }
    }
}

/// The files in a folder, none of them behind a link.
fn files(folder: &Path, below: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    // `join` of nothing would end it with a slash, behind which a link is followed.
    let here = folder.components().chain(below.components()).collect::<PathBuf>();
    if !fs::symlink_metadata(&here)?.is_dir() {
        return Err(io::ErrorKind::NotADirectory.into());
    }
    for entry in fs::read_dir(here)? {
        let entry = entry?;
        let (path, kind) = (below.join(entry.file_name()), entry.file_type()?);
        if kind.is_dir() {
            files(folder, &path, found)?;
        } else if kind.is_file() {
            found.push(path);
        }
    }
    Ok(())
}
