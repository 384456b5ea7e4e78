//! Which folders are URDDs, and which files in them are theirs.

use std::collections::BTreeSet;
use std::fs;
use std::ops::Bound;
use std::path::{Path, PathBuf};

use serde_json::Value;
use thiserror::Error;

pub use crate::file_type::ROOT_METADATA;
use crate::file_type::{FileType, is_archive, is_staging, stem};
use crate::limits::{MAX_DOCUMENT_BYTES, MAX_FILES, MAX_FOLDER_DEPTH};
use crate::listing::{Entry, EntryKind, Listing, ReadError};
use crate::root::Root;
use crate::source::{OpenFile, Source, is_urdd};
use crate::{file_entry, json};
use urdd_format::registry::ModuleKind;

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

/// The files of every module and of every extension.
const OF_MODULE: [&str; 4] = ["VERSION", "module.json", "module.yaml", "schema.json"];

/// A view of the URDD without unrelated files below its root.
///
/// With `urdd.json`: that file, the source that it names, and the files that it lists for modules. Without it (a legacy
/// URDD), or if it is not JSON: the URDFs in the root folder, and for each module `VERSION`, its documents, and the
/// module files that its document names. Other files inside a module's folder count only if listed. The source must be
/// in the root folder, and its name must end in `.urdf` or its hash must match: `urdd.json` is untrusted, and must not
/// expose a private file.
///
/// # Errors
/// If the root cannot be listed.
pub fn carried(root: &Root) -> Result<Root, ReadError> {
    let listing = root.list()?;
    let metadata = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).ok();
    let metadata = metadata.and_then(|bytes| Some(json::read(&bytes).ok()?.value));
    let named = match metadata {
        Some(metadata) => listed(root, metadata),
        None => named_by_modules(root, &listing),
    };
    let is_own = |path: &str| {
        (path == ROOT_METADATA || named.contains(path)) && !leads_away(root, path, &named)
    };
    let files = listing.entries.iter();
    let files = files.filter(|entry| entry.kind == EntryKind::File && entry.utf8);
    let files = files.map(|entry| entry.path.clone()).filter(|path| is_own(path)).collect();
    Ok(Root::of(Carried { root: root.clone(), files }))
}

/// Whether a path is a symbolic link to a file outside the URDD's own files.
fn leads_away(root: &Root, path: &str, named: &BTreeSet<String>) -> bool {
    let Some(folder) = root.folder() else {
        return false;
    };
    let file = folder.join(path);
    if !fs::symlink_metadata(&file).is_ok_and(|metadata| metadata.is_symlink()) {
        return false;
    }
    let target = fs::canonicalize(&file).ok();
    let target = target.zip(fs::canonicalize(folder).ok());
    !target.is_some_and(|(target, folder)| {
        let below = target.strip_prefix(&folder).ok();
        below
            .and_then(Path::to_str)
            .is_some_and(|path| named.contains(&*path.replace(std::path::MAIN_SEPARATOR, "/")))
    })
}

/// The files that `urdd.json` lists.
fn listed(root: &Root, mut metadata: Value) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in file_entry::of_modules(&mut metadata) {
        if let Some(path) = file_entry::path(entry).filter(|path| is_in_module(path)) {
            found.insert(path.to_owned());
        }
    }
    let source = metadata.pointer("/source/Urdf");
    if let Some(source) = source
        && let Some(path) = file_entry::path(source)
        && !path.contains('/')
        && (is_urdf(path) || is_unchanged(root, path, source))
    {
        found.insert(path.to_owned());
    }
    found
}

fn is_unchanged(root: &Root, path: &str, entry: &Value) -> bool {
    file_entry::of(root, path).is_ok_and(|(_, sha256)| entry["sha256"] == sha256)
}

/// The files of a URDD without `urdd.json`.
fn named_by_modules(root: &Root, listing: &Listing) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let own = format!("{}/", root.folder_name());
    for entry in &listing.entries {
        if !entry.path.contains('/') && is_urdf(&entry.path) {
            found.insert(entry.path.clone());
            continue;
        }
        let Some((folder, name)) = entry.path.rsplit_once('/') else {
            continue;
        };
        if !is_module(folder) || !OF_MODULE.contains(&name) {
            continue;
        }
        found.insert(entry.path.clone());
        if name == "module.json"
            && let Ok(bytes) = root.read(&entry.path, MAX_DOCUMENT_BYTES)
            && let Ok(document) = json::read(&bytes)
        {
            texts(&document.value, &mut |text| {
                // Before version 1, paths began with the name of the root folder.
                let path = text.strip_prefix(&own).unwrap_or(text);
                if is_in_module(path) {
                    found.insert(path.to_owned());
                }
            });
        }
    }
    found
}

fn texts(value: &Value, take: &mut dyn FnMut(&str)) {
    match value {
        Value::String(text) => take(text),
        Value::Array(list) => list.iter().for_each(|value| texts(value, take)),
        Value::Object(map) => map.values().for_each(|value| texts(value, take)),
        _ => {}
    }
}

fn is_urdf(path: &str) -> bool {
    let path = Path::new(path);
    FileType::Urdf.is_of(path) && !stem(path).is_empty()
}

/// Whether this is the folder of a specified module or of an extension.
fn is_module(folder: &str) -> bool {
    let is_extension = || {
        let middle = folder.strip_prefix("x_")?.strip_suffix("_module")?;
        Some(!middle.contains('/'))
    };
    ModuleKind::ALL.iter().any(|kind| kind.folder() == folder) || is_extension() == Some(true)
}

fn is_in_module(path: &str) -> bool {
    let mut slashes = path.match_indices('/');
    slashes.any(|(slash, _)| is_module(&path[..slash]))
}

/// A source restricted to the files of a URDD.
#[derive(Debug)]
struct Carried {
    root: Root,
    files: BTreeSet<String>,
}

impl Source for Carried {
    fn folder_name(&self) -> String {
        self.root.folder_name()
    }

    fn list(&self) -> Result<Listing, ReadError> {
        let mut listing = self.root.list()?;
        let is_own = |entry: &Entry| match entry.kind {
            EntryKind::Folder => {
                let below = format!("{}/", entry.path);
                let from = (Bound::Excluded(below.as_str()), Bound::Unbounded);
                let mut after = self.files.range::<str, _>(from);
                after.next().is_some_and(|file| file.starts_with(&below))
            }
            _ => self.files.contains(&entry.path),
        };
        listing.entries.retain(is_own);
        Ok(listing)
    }

    fn open(&self, path: &str) -> Result<(OpenFile, u64), ReadError> {
        if self.files.contains(path) { self.root.open_file(path) } else { Err(ReadError::Missing) }
    }

    fn folder(&self) -> Option<&Path> {
        self.root.folder()
    }
}
