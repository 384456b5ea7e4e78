//! What a new URDD takes over from the folder that it replaces: everything that is not of this
//! format. A README, a `.git` folder and extension modules outlive a new run.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::metadata::FOUND_KEY;
use super::old::Old;
use crate::directory::digest;
use crate::directory::discover::ROOT_METADATA;
use crate::directory::root::Root;
use crate::directory::staging::StagingError;
use crate::format::registry::ModuleKind;

/// Links or copies what is to stay from `folder` into `root`, where it is not there yet.
pub(super) fn carry_over(
    folder: &Path,
    old: Option<&Old>,
    root: &Path,
) -> Result<(), StagingError> {
    let mut ours: BTreeSet<&str> = [ROOT_METADATA].into();
    let folders = ModuleKind::ALL.iter().map(|kind| kind.folder());
    ours.extend(folders.map(|path| path.split('/').next().unwrap_or(path)));
    if let Some(old) = old {
        let source = &old.value["source"];
        let paths = [&source["Urdf"]["path"], &source[FOUND_KEY]["path"]];
        ours.extend(paths.iter().filter_map(|path| path.as_str()));
    }
    let unread = |error| StagingError::Read {
        path: folder.to_owned(),
        error,
    };
    for entry in fs::read_dir(folder).map_err(unread)? {
        let name = entry.map_err(unread)?.file_name();
        let is_ours = name.to_str().is_some_and(|name| ours.contains(name));
        if !is_ours && fs::symlink_metadata(root.join(&name)).is_err() {
            take(&folder.join(&name), &root.join(&name))?;
        }
    }
    Ok(())
}

fn take(from: &Path, to: &Path) -> Result<(), StagingError> {
    let read = |error| StagingError::Read {
        path: from.to_owned(),
        error,
    };
    let write = |error| StagingError::Write {
        path: to.to_owned(),
        error,
    };
    let kind = fs::symlink_metadata(from).map_err(read)?.file_type();
    if kind.is_dir() {
        fs::create_dir(to).map_err(write)?;
        for entry in fs::read_dir(from).map_err(read)? {
            let name = entry.map_err(read)?.file_name();
            take(&from.join(&name), &to.join(&name))?;
        }
        return Ok(());
    }
    #[cfg(unix)]
    if kind.is_symlink() {
        let target = fs::read_link(from).map_err(read)?;
        return std::os::unix::fs::symlink(target, to).map_err(write);
    }
    if fs::hard_link(from, to).is_err() {
        fs::copy(from, to).map_err(write)?;
    }
    Ok(())
}

/// The entries of extension modules that were carried over, their sizes and hashes brought up to
/// date.
pub(super) fn extensions(old: Option<&Old>, root: &Path) -> Vec<Value> {
    let modules = old.and_then(|old| old.value["modules"].as_array());
    let Ok(root) = Root::open(root) else {
        return Vec::new();
    };
    let known = |name: &str| ModuleKind::ALL.iter().any(|kind| kind.name() == name);
    let mut entries = Vec::new();
    for module in modules.into_iter().flatten() {
        if module["name"].as_str().is_none_or(known) {
            continue;
        }
        let mut module = module.clone();
        for file in module["files"].as_array_mut().into_iter().flatten() {
            let found = file["path"]
                .as_str()
                .and_then(|path| digest::of(&root, path).ok());
            if let Some((size, sha256)) = found {
                file["size"] = json!(size);
                file["sha256"] = json!(sha256);
            }
        }
        entries.push(module);
    }
    entries
}
