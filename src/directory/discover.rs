//! Finding URDDs below a path.

use std::fs;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::limits::{MAX_FILES, MAX_FOLDER_DEPTH};
use crate::format::registry::ModuleKind;

/// Name of the root metadata file.
pub const ROOT_METADATA: &str = "urdd.json";

/// A URDD that was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Found {
    /// Where it is.
    pub path: PathBuf,
    /// How reports call it: its path from the searched folder, with forward slashes, or the
    /// searched folder's own name.
    pub name: String,
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
        "{path}: this is a file; a URDD is a folder: give the folder that holds {ROOT_METADATA} or the module folders"
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
}

/// Whether a folder is the root of a URDD: it holds `urdd.json`, or a module's folder.
pub fn is_urdd(folder: &Path) -> bool {
    folder.join(ROOT_METADATA).is_file()
        || ModuleKind::ALL
            .iter()
            .any(|kind| folder.join(kind.folder()).is_dir())
}

/// Finds every URDD at or below a path, at any depth, in order of path. A URDD is not searched for
/// more of them; symbolic links below `path` are not followed.
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
    if !canonical.is_dir() {
        return Err(DiscoverError::NotAFolder { path: shown });
    }
    if is_urdd(&canonical) {
        let name = canonical
            .file_name()
            .map_or_else(|| shown.clone(), |name| name.to_string_lossy().into_owned());
        return Ok(vec![Found {
            path: path.to_owned(),
            name,
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
        let Ok(entries) = fs::read_dir(&folder) else {
            continue;
        };
        for entry in entries.flatten() {
            visited += 1;
            // Not followed: a link may lead in a circle, or anywhere.
            let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
            if !is_folder || depth + 1 >= MAX_FOLDER_DEPTH || visited > 10 * MAX_FILES {
                continue;
            }
            let name = entry.file_name().to_string_lossy().into_owned();
            let name = if prefix.is_empty() {
                name
            } else {
                format!("{prefix}/{name}")
            };
            if is_urdd(&entry.path()) {
                found.push(Found {
                    path: entry.path(),
                    name,
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
