//! Replaces the contents of a folder but keeps the folder itself, because it is in use as a current folder.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::Path;

use crate::discover::ROOT_METADATA;

/// Moves each entry of `content` into `target`, and the replaced ones into `old`. On failure, restores all of them.
/// Removes entries of `target` that `content` lacks. Moves `urdd.json` last: until then, the hashes show that the
/// folder is incomplete.
pub fn put(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
    fs::create_dir(old)?;
    put_into(content, target, old)
}

pub fn put_into(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
    let names = names(content)?;
    let done = names.iter().try_for_each(|name| {
        let place = target.join(name);
        if fs::symlink_metadata(&place).is_ok() {
            fs::rename(&place, old.join(name))?;
        }
        fs::rename(content.join(name), &place)
    });
    let Err(error) = done else {
        for name in self::names(target)? {
            if !names.contains(&name) {
                fs::rename(target.join(&name), old.join(&name))?;
            }
        }
        return fs::remove_dir_all(old);
    };
    for name in &names {
        // Move new entries back first, to make room for the old ones.
        if fs::symlink_metadata(content.join(name)).is_err() {
            fs::rename(target.join(name), content.join(name))?;
        }
    }
    put_back(old, target)?;
    Err(error)
}

/// Restores entries of `target` that an interrupted run removed and did not replace.
pub fn put_back(old: &Path, target: &Path) -> io::Result<()> {
    if !old.is_dir() || !target.is_dir() {
        return Ok(());
    }
    for name in names(old)? {
        if fs::symlink_metadata(target.join(&name)).is_err() {
            fs::rename(old.join(&name), target.join(&name))?;
        }
    }
    Ok(())
}

/// The names in a folder, with `urdd.json` last.
fn names(folder: &Path) -> io::Result<Vec<OsString>> {
    let entries = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name()));
    let mut names = entries.collect::<io::Result<Vec<OsString>>>()?;
    names.sort_by_key(|name| (name == ROOT_METADATA, name.clone()));
    Ok(names)
}
