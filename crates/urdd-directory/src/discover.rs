//! Finding URDDs below a path.

use std::fs;
use std::path::{Path, PathBuf};

use thiserror::Error;

pub use super::layout::ROOT_METADATA;
use super::layout::is_staging;
use super::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use super::read_error::ReadError;
use super::source::{is_archive, is_urdd};

/// A URDD found by [`discover`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Its path.
    pub path: PathBuf,
    /// Its name in reports: the path relative to the searched folder, with forward slashes, or the searched folder's
    /// own name.
    pub name: String,
    /// Why this folder was not searched, so that URDDs may be missing: it cannot be listed, or is too deep.
    pub closed: Option<ReadError>,
}

/// Why a path yields nothing to examine.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum DiscoverError {
    #[error("{path}: no such file or folder")]
    Missing { path: String },
    #[error(
        "{path}: this is a file; a URDD is a folder, or a zip archive of one: give the folder that holds {ROOT_METADATA} or the module folders"
    )]
    NotAFolder { path: String },
    #[error(
        "{path}: no URDD here: no folder at or below it holds {ROOT_METADATA} or a module folder such as urdf_module"
    )]
    NoUrdd { path: String },
    #[error("{path}: the folder cannot be listed: {reason}")]
    Unreadable { path: String, reason: String },
    #[error(
        "{path}: more than {limit} files and folders: give the URDDs themselves, or smaller folders"
    )]
    TooMany { path: String, limit: usize },
}

/// Maximum number of folder entries visited in one search.
const MAX_VISITED: usize = 10 * MAX_FILES;

/// Finds every URDD at or below a path, at any depth, sorted by name. The path may be a zip archive; archives inside
/// folders are skipped. Does not search inside a URDD, does not follow symbolic links below `path`, and skips staging
/// folders. A folder that cannot be searched is in the result with `closed` set.
///
/// # Errors
/// If the path contains no URDD, or cannot be searched.
pub fn discover(path: &Path) -> Result<Vec<Found>, DiscoverError> {
    let shown = path.display().to_string();
    let canonical = fs::canonicalize(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::PermissionDenied => DiscoverError::Unreadable {
            path: shown.clone(),
            reason: "permission denied".to_owned(),
        },
        _ => DiscoverError::Missing { path: shown.clone() },
    })?;
    if !canonical.is_dir() && !is_archive(&canonical) {
        return Err(DiscoverError::NotAFolder { path: shown });
    }
    if !canonical.is_dir() || is_urdd(&canonical) {
        let name = canonical
            .file_name()
            .map_or_else(|| shown.clone(), |name| name.to_string_lossy().into_owned());
        return Ok(vec![Found { path: path.to_owned(), name, closed: None }]);
    }
    if let Err(error) = fs::read_dir(&canonical) {
        return Err(DiscoverError::Unreadable { path: shown, reason: error.kind().to_string() });
    }
    let mut found = Vec::new();
    let mut visited = 0;
    let mut folders = vec![(path.to_owned(), String::new(), 0)];
    while let Some((folder, prefix, depth)) = folders.pop() {
        let entries = match list(&folder, depth) {
            Ok(entries) => entries,
            Err(error) => {
                found.push(Found { path: folder, name: prefix, closed: Some(error) });
                continue;
            }
        };
        for entry in entries.flatten() {
            visited += 1;
            if visited > MAX_VISITED {
                return Err(DiscoverError::TooMany { path: shown, limit: MAX_VISITED });
            }
            // Not followed: a link may form a cycle or lead anywhere.
            if !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                continue;
            }
            let name = entry.file_name().to_string_lossy().into_owned();
            if is_staging(&name) {
                continue;
            }
            let name = if prefix.is_empty() { name } else { format!("{prefix}/{name}") };
            if is_urdd(&entry.path()) {
                found.push(Found { path: entry.path(), name, closed: None });
            } else {
                folders.push((entry.path(), name, depth + 1));
            }
        }
    }
    if found.is_empty() {
        return Err(DiscoverError::NoUrdd { path: shown });
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(found)
}

fn list(folder: &Path, depth: usize) -> Result<fs::ReadDir, ReadError> {
    let entries = fs::read_dir(folder)?;
    match depth < MAX_FOLDER_DEPTH {
        true => Ok(entries),
        false => Err(ReadError::TooDeep { limit: MAX_FOLDER_DEPTH }),
    }
}
