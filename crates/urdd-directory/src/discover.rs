//! Finding URDDs below a path.

use std::fs;
use std::path::{Path, PathBuf};

use thiserror::Error;

pub use super::layout::ROOT_METADATA;
use super::layout::is_staging;
use super::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use super::read_error::ReadError;
use super::source::{is_archive, is_urdd};

/// A URDD that was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Where it is.
    pub path: PathBuf,
    /// How reports call it: its path from the searched folder, with forward slashes, or the
    /// searched folder's own name.
    pub name: String,
    /// Why it cannot be looked into, so that URDDs may be missed: a folder that cannot be listed, or
    /// that lies too deep.
    pub closed: Option<ReadError>,
}

/// Why there is nothing to examine under a path.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum DiscoverError {
    /// No such path.
    #[error("{path}: no such file or folder")]
    Missing {
        /// The path as given.
        path: String,
    },
    /// A file.
    #[error(
        "{path}: this is a file; a URDD is a folder, or a zip archive of one: give the folder that holds {ROOT_METADATA} or the module folders"
    )]
    NotAFolder {
        /// The path as given.
        path: String,
    },
    /// A folder without any URDD in it.
    #[error(
        "{path}: no URDD here: no folder at or below it holds {ROOT_METADATA} or a module folder such as urdf_module"
    )]
    NoUrdd {
        /// The path as given.
        path: String,
    },
    /// A folder that cannot be listed.
    #[error("{path}: the folder cannot be listed: {reason}")]
    Unreadable {
        /// The path as given.
        path: String,
        /// What the operating system said.
        reason: String,
    },
    /// A folder with more below it than is searched.
    #[error(
        "{path}: more than {limit} files and folders: give the URDDs themselves, or smaller folders"
    )]
    TooMany {
        /// The path as given.
        path: String,
        /// How many are looked at.
        limit: usize,
    },
}

/// Most entries of folders that are looked at in search of URDDs.
const MAX_VISITED: usize = 10 * MAX_FILES;

/// Finds every URDD at or below a path, at any depth, in order of path. The path may be that of a zip
/// archive; archives in folders are not looked into. A URDD is not searched for more of them;
/// symbolic links below `path` are not followed, and folders in which a URDD is being written are
/// passed over. A folder that cannot be searched is among the found, closed.
///
/// # Errors
/// Where the path holds none, or cannot be searched.
pub fn discover(path: &Path) -> Result<Vec<Found>, DiscoverError> {
    let shown = path.display().to_string();
    let canonical = fs::canonicalize(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::PermissionDenied => DiscoverError::Unreadable {
            path: shown.clone(),
            reason: "permission denied".to_owned(),
        },
        _ => DiscoverError::Missing {
            path: shown.clone(),
        },
    })?;
    if !canonical.is_dir() && !is_archive(&canonical) {
        return Err(DiscoverError::NotAFolder { path: shown });
    }
    if !canonical.is_dir() || is_urdd(&canonical) {
        let name = canonical
            .file_name()
            .map_or_else(|| shown.clone(), |name| name.to_string_lossy().into_owned());
        return Ok(vec![Found {
            path: path.to_owned(),
            name,
            closed: None,
        }]);
    }
    if let Err(error) = fs::read_dir(&canonical) {
        return Err(DiscoverError::Unreadable {
            path: shown,
            reason: error.kind().to_string(),
        });
    }
    let mut found = Vec::new();
    let mut visited = 0;
    let mut folders = vec![(path.to_owned(), String::new(), 0)];
    while let Some((folder, prefix, depth)) = folders.pop() {
        let entries = match list(&folder, depth) {
            Ok(entries) => entries,
            Err(error) => {
                found.push(Found {
                    path: folder,
                    name: prefix,
                    closed: Some(error),
                });
                continue;
            }
        };
        for entry in entries.flatten() {
            visited += 1;
            if visited > MAX_VISITED {
                return Err(DiscoverError::TooMany {
                    path: shown,
                    limit: MAX_VISITED,
                });
            }
            // Not followed: a link may lead in a circle, or anywhere.
            if !entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                continue;
            }
            let name = entry.file_name().to_string_lossy().into_owned();
            if is_staging(&name) {
                continue;
            }
            let name = if prefix.is_empty() {
                name
            } else {
                format!("{prefix}/{name}")
            };
            if is_urdd(&entry.path()) {
                found.push(Found {
                    path: entry.path(),
                    name,
                    closed: None,
                });
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
    let entries = fs::read_dir(folder).map_err(|error| ReadError::from_io(&error))?;
    match depth < MAX_FOLDER_DEPTH {
        true => Ok(entries),
        false => Err(ReadError::TooDeep {
            limit: MAX_FOLDER_DEPTH,
        }),
    }
}
