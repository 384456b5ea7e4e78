//! Which files below a URDD's root are the URDD's own: only these leave the machine or enter a browser. A person keeps
//! other files beside them (`.env`, `.git`, notes), and nobody asked for those to be published.

use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::ops::Bound;
use std::path::Path;

use serde_json::Value;

use super::digest;
use super::file_entry;
use super::json;
use super::layout::ROOT_METADATA;
use super::limits::MAX_DOCUMENT_BYTES;
use super::listing::{Entry, EntryKind, Listing};
use super::read_error::ReadError;
use super::root::Root;
use super::source::{OpenFile, Source};
use urdd_format::registry::ModuleKind;

/// The files that every module has, and that an extension has.
const OF_MODULE: [&str; 4] = ["VERSION", "module.json", "module.yaml", "schema.json"];

/// A URDD without the other files below its root.
///
/// With `urdd.json`: itself, the source that it names, and the files that it lists for modules. Without it (a legacy
/// URDD), or where it is not JSON: the URDFs in the root folder, and of each module `VERSION`, its documents, and the files
/// of modules that its document names. A file inside a module's folder counts where it is listed. The source counts
/// where its name ends in `.urdf`, or its content is the stated one: `urdd.json` comes from anybody, and must not name a
/// person's file.
///
/// # Errors
/// Where the root cannot be listed.
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
    let files: BTreeSet<String> = listing
        .entries
        .iter()
        .filter(|entry| entry.kind == EntryKind::File && entry.utf8 && is_own(&entry.path))
        .map(|entry| entry.path.clone())
        .collect();
    Ok(Root::of(Carried {
        root: root.clone(),
        files,
    }))
}

/// Whether a path is that of a link to a file that is not the URDD's.
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

/// The files that `urdd.json` names.
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
    digest::of(root, path).is_ok_and(|(_, sha256)| entry["sha256"] == sha256)
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
                // Before version 1 paths began with the folder's own name.
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
    let (stem, extension) = path.rsplit_once('.').unwrap_or((path, ""));
    extension.eq_ignore_ascii_case("urdf") && !stem.is_empty()
}

/// Whether a folder is that of a module of the specification, or of an extension.
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

/// The files of a URDD, and no other.
struct Carried {
    root: Root,
    files: BTreeSet<String>,
}

impl fmt::Debug for Carried {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} files of {:?}", self.files.len(), self.root)
    }
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
        match self.files.contains(path) {
            true => self.root.open_file(path),
            false => Err(ReadError::Missing),
        }
    }

    fn folder(&self) -> Option<&Path> {
        self.root.folder()
    }
}
