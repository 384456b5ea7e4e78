//! Files and folders on the disk as wholes: copied unchanged, removed, given the permissions of others. A copy is a hard
//! link where the file system supports it, and a symbolic link stays one.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::unfinished::writing;

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

impl StagingError {
    /// Of a path that cannot be read.
    pub(crate) fn read(path: &Path) -> impl Fn(io::Error) -> Self {
        |error| StagingError::Read { path: path.to_owned(), error }
    }

    /// Of a path that cannot be written.
    pub(crate) fn write(path: &Path) -> impl Fn(io::Error) -> Self {
        |error| StagingError::Write { path: path.to_owned(), error }
    }
}

fn in_words(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            format!("the disk is full ({error}); nothing was changed")
        }
        _ => error.to_string(),
    }
}

/// Copies a file, a symbolic link or a folder. `to` must not exist.
///
/// # Errors
/// If something cannot be read or written.
pub fn take(from: &Path, to: &Path) -> Result<(), StagingError> {
    let kind = fs::symlink_metadata(from).map_err(StagingError::read(from))?;
    match kind.is_dir() {
        true => {
            folder(to)?;
            take_content(from, to, &|_| false)
        }
        false => file(from, to),
    }
}

/// Copies a folder's contents, except files for whose relative path `without` returns true. `to` must exist.
///
/// # Errors
/// As for [`take`].
pub fn take_content(
    from: &Path,
    to: &Path,
    without: &dyn Fn(&Path) -> bool,
) -> Result<(), StagingError> {
    content(from, to, Path::new(""), without)
}

fn content(
    from: &Path,
    to: &Path,
    below: &Path,
    without: &dyn Fn(&Path) -> bool,
) -> Result<(), StagingError> {
    let here = from.join(below);
    for entry in fs::read_dir(&here).map_err(StagingError::read(&here))? {
        let entry = entry.map_err(StagingError::read(&here))?;
        let below = below.join(entry.file_name());
        let (source, target) = (from.join(&below), to.join(&below));
        let kind = entry.file_type().map_err(StagingError::read(&source))?;
        if kind.is_dir() {
            folder(&target)?;
            content(from, to, &below, without)?;
        } else if !without(&below) {
            file(&source, &target)?;
        }
    }
    Ok(())
}

fn folder(place: &Path) -> Result<(), StagingError> {
    let _writing = writing();
    fs::create_dir(place).map_err(StagingError::write(place))
}

/// Copies a file or a symbolic link. `to` must not exist.
pub(crate) fn file(from: &Path, to: &Path) -> Result<(), StagingError> {
    let _writing = writing();
    #[cfg(unix)]
    if fs::symlink_metadata(from).is_ok_and(|metadata| metadata.is_symlink()) {
        let target = fs::read_link(from).map_err(StagingError::read(from))?;
        return std::os::unix::fs::symlink(target, to).map_err(StagingError::write(to));
    }
    if fs::hard_link(from, to).is_err() {
        fs::copy(from, to).map_err(StagingError::write(to))?;
    }
    Ok(())
}

/// Removes a folder, including read-only folders in it.
pub(crate) fn remove(folder: &Path) {
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
pub(crate) fn keep_modes(old: &Path, new: &Path) -> io::Result<()> {
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
