//! Copies files and folders unchanged: hard links where the file system supports them, else copies. A symbolic link
//! stays a symbolic link.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::fs;
use std::path::Path;

use super::staging::StagingError;

/// Copies a file, a symbolic link or a folder. `to` must not exist.
///
/// # Errors
/// If something cannot be read or written.
pub fn take(from: &Path, to: &Path) -> Result<(), StagingError> {
    let kind = fs::symlink_metadata(from).map_err(|error| unread(from, error))?;
    match kind.is_dir() {
        true => {
            fs::create_dir(to).map_err(|error| unwritten(to, error))?;
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
    let folder = from.join(below);
    for entry in fs::read_dir(&folder).map_err(|error| unread(&folder, error))? {
        let entry = entry.map_err(|error| unread(&folder, error))?;
        let below = below.join(entry.file_name());
        let (source, target) = (from.join(&below), to.join(&below));
        let kind = entry.file_type().map_err(|error| unread(&source, error))?;
        if kind.is_dir() {
            fs::create_dir(&target).map_err(|error| unwritten(&target, error))?;
            content(from, to, &below, without)?;
        } else if !without(&below) {
            file(&source, &target)?;
        }
    }
    Ok(())
}

/// Copies a file or a symbolic link. `to` must not exist.
pub(crate) fn file(from: &Path, to: &Path) -> Result<(), StagingError> {
    #[cfg(unix)]
    if fs::symlink_metadata(from).is_ok_and(|metadata| metadata.is_symlink()) {
        let target = fs::read_link(from).map_err(|error| unread(from, error))?;
        return std::os::unix::fs::symlink(target, to).map_err(|error| unwritten(to, error));
    }
    if fs::hard_link(from, to).is_err() {
        fs::copy(from, to).map_err(|error| unwritten(to, error))?;
    }
    Ok(())
}

fn unread(path: &Path, error: std::io::Error) -> StagingError {
    let path = path.to_owned();
    StagingError::Read { path, error }
}

fn unwritten(path: &Path, error: std::io::Error) -> StagingError {
    let path = path.to_owned();
    StagingError::Write { path, error }
}
