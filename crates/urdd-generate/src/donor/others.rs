//! All other files of the folder that is replaced: every file that its URDD does not list and that does not belong to a
//! module. A README, a `.git` folder, extension modules and notes in a module's folder survive a new run.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use super::Donor;
use crate::metadata::FOUND_KEY;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::root::Root;
use urdd_directory::staging::StagingError;
use urdd_directory::take::take;
use urdd_directory::{digest, file_entry, outputs};
use urdd_format::registry::ModuleKind;

/// The files that every module has.
const MODULE_FILES: [&str; 3] = ["VERSION", "module.json", "module.yaml"];

/// Links or copies the files to keep from `folder` into `root`.
/// Fails if something cannot be read or written, or a user's file has a name that the URDD needs.
pub(crate) fn carry_over(
    folder: &Path,
    replaced: Option<&Donor>,
    root: &Path,
) -> Result<(), StagingError> {
    merge(folder, root, "", &replaced.map(listed).unwrap_or_default())
}

/// The modules that were not made, but whose folders have files that were carried over.
pub(crate) fn left_behind(root: &Path, made: &[ModuleKind]) -> Vec<ModuleKind> {
    let kinds = ModuleKind::ALL.iter().copied();
    kinds.filter(|kind| !made.contains(kind) && root.join(kind.folder()).exists()).collect()
}

/// Every path that the replaced URDD lists, except those of extension modules.
fn listed(replaced: &Donor) -> BTreeSet<String> {
    let source = &replaced.value["source"];
    let sources = [&source["Urdf"]["path"], &source[FOUND_KEY]["path"]];
    let sources = sources.iter().filter_map(|path| path.as_str());
    let modules = replaced.metadata.modules.iter();
    let files = modules.filter(|module| is_known(&module.name)).flat_map(|module| &module.files);
    files.map(|file| file.path.clone()).chain(sources.map(str::to_owned)).collect()
}

fn is_known(module: &str) -> bool {
    ModuleKind::ALL.iter().any(|kind| kind.name() == module)
}

/// Carries over the folder at `path`, relative to both roots. Folders of modules are merged entry by entry.
fn merge(
    folder: &Path,
    root: &Path,
    path: &str,
    listed: &BTreeSet<String>,
) -> Result<(), StagingError> {
    let from = folder.join(path);
    let unread = |error| StagingError::Read { path: from.clone(), error };
    for entry in fs::read_dir(&from).map_err(unread)? {
        let entry = entry.map_err(unread)?;
        let name = entry.file_name();
        let inside = match (path, name.to_string_lossy()) {
            ("", name) => name.into_owned(),
            (path, name) => format!("{path}/{name}"),
        };
        let from = entry.path();
        let to = root.join(path).join(&name);
        let kind = entry.file_type().map_err(unread)?;
        if kind.is_dir() {
            let there = fs::symlink_metadata(&to);
            let is_free = there.as_ref().map_or(inside != ROOT_METADATA, |there| there.is_dir());
            if is_free && is_of_modules(&inside) {
                merge(folder, root, &inside, listed)?;
            } else if is_free && there.is_err() {
                make_above(&to)?;
                take(&from, &to)?;
            } else {
                return Err(StagingError::InTheWay { path: from });
            }
        } else if is_ours(&inside, listed) {
            // A pipe, a device or a socket.
            if !kind.is_file() && !kind.is_symlink() {
                return Err(StagingError::InTheWay { path: from });
            }
        } else {
            make_above(&to)?;
            match fs::symlink_metadata(&to) {
                Err(_) => take(&from, &to)?,
                Ok(_) if is_same(&from, &to) => {}
                Ok(_) => return Err(StagingError::InTheWay { path: from }),
            }
        }
    }
    Ok(())
}

fn make_above(path: &Path) -> Result<(), StagingError> {
    let Some(above) = path.parent() else { return Ok(()) };
    fs::create_dir_all(above).map_err(|error| StagingError::Write { path: above.to_owned(), error })
}

/// Whether a folder is a module's, or contains one, or is inside one.
fn is_of_modules(path: &str) -> bool {
    let begins = |long: &str, short: &str| {
        long.strip_prefix(short).is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let mut folders = ModuleKind::ALL.iter().map(|kind| kind.folder());
    folders.any(|folder| begins(path, folder) || begins(folder, path))
}

/// Whether a file belongs to the replaced URDD: `urdd.json`, a listed file, or a module's own file.
fn is_ours(path: &str, listed: &BTreeSet<String>) -> bool {
    let of_a_module = || {
        let (folder, file) = path.rsplit_once('/')?;
        let is_module = ModuleKind::ALL.iter().any(|kind| kind.folder() == folder);
        Some(is_module && MODULE_FILES.contains(&file))
    };
    path == ROOT_METADATA || listed.contains(path) || of_a_module().unwrap_or(false)
}

fn is_same(one: &Path, other: &Path) -> bool {
    fs::read(other).is_ok_and(|bytes| !outputs::is_other(one, &bytes))
}

/// The entries of extension modules that were carried over, with updated sizes and hashes.
pub(crate) fn extensions(replaced: Option<&Donor>, root: &Path) -> Vec<Value> {
    let modules = replaced.and_then(|replaced| replaced.value["modules"].as_array());
    let Ok(root) = Root::open(root) else { return Vec::new() };
    let mut entries = Vec::new();
    for module in modules.into_iter().flatten() {
        if module["name"].as_str().is_none_or(is_known) {
            continue;
        }
        let mut module = module.clone();
        for entry in file_entry::of_module(&mut module) {
            let found = file_entry::path(entry).and_then(|path| digest::of(&root, path).ok());
            if let Some((size, sha256)) = found {
                file_entry::update(entry, size, &sha256);
            }
        }
        entries.push(module);
    }
    entries
}
