//! Moves files into a folder that has other files too, one by one.
//!
//! The files that will be replaced are copied to `was`. Then the new files become `ready`, which decides: if the run is
//! killed from then on, the next run into the same place moves what is left in `ready`, and leaves alone what somebody
//! changed in between.
#![expect(clippy::disallowed_methods, reason = "this is where files are written")]

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use same_file::is_same_file;

use crate::discover::ROOT_METADATA;
use crate::{digest, regular};

/// The prepared files.
pub const CONTENT: &str = "new";
const READY: &str = "ready";
const WAS: &str = "was";

/// Moves prepared files into a folder, in this order. A new folder moves as a whole.
///
/// # Errors
/// The file that cannot be moved, and why. The folder is as before then.
pub fn put<'p>(
    workplace: &Path,
    folder: &Path,
    paths: &[&'p Path],
) -> Result<(), (&'p Path, io::Error)> {
    let [content, ready, was] = [CONTENT, READY, WAS].map(|name| workplace.join(name));
    for path in paths {
        keep(folder, &content, &was, path).map_err(|error| (*path, error))?;
    }
    let mut known = BTreeSet::new();
    let parts = paths.iter().map(|path| new_part(folder, path));
    let parts: Vec<&Path> = parts.filter(|part| known.insert(*part)).collect();
    if let [part, _, ..] = parts.as_slice() {
        fs::rename(&content, &ready).map_err(|error| (*part, error))?;
    }
    let from = if parts.len() > 1 { &ready } else { &content };
    let place = |part: &&'p Path| (*part, from.join(part), folder.join(part));
    let moves: Vec<_> = parts.iter().map(place).collect();
    // A kill between two of these is what the next run has to complete: nothing else is done here.
    for (number, (part, from, to)) in moves.iter().enumerate() {
        if let Err(error) = fs::rename(from, to) {
            for (part, _, place) in &moves[..number] {
                let _ = fs::rename(was.join(part), place)
                    .or_else(|_| fs::remove_file(place))
                    .or_else(|_| fs::remove_dir_all(place));
            }
            let _ = fs::rename(&ready, &content);
            return Err((part, error));
        }
    }
    Ok(())
}

/// Moves the files that differ from those of the target, `urdd.json` last: until then, the hashes show that the folder is
/// incomplete.
pub fn put_changed(workplace: &Path, target: &Path) -> io::Result<()> {
    let (content, mut paths) = (workplace.join(CONTENT), Vec::new());
    files(&content, Path::new(""), &mut paths)?;
    paths.retain(|path| !is_same_file(content.join(path), target.join(path)).unwrap_or(false));
    paths.sort_by_key(|path| path.as_os_str() == ROOT_METADATA);
    let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    put(workplace, target, &paths).map_err(|(_, error)| error)
}

/// Copies the file that will be replaced, and gives the new one its permissions.
fn keep(folder: &Path, new: &Path, was: &Path, path: &Path) -> io::Result<()> {
    let (place, copy) = (folder.join(path), was.join(path));
    let Ok(there) = fs::metadata(&place) else {
        return Ok(());
    };
    copy.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::copy(&place, &copy)?;
    fs::set_permissions(new.join(path), there.permissions())
}

/// The outermost folder on the way to a file that is new, or the file.
fn new_part<'p>(folder: &Path, path: &'p Path) -> &'p Path {
    let is_new = |part: &&Path| fs::symlink_metadata(folder.join(part)).is_err();
    let parts: Vec<&Path> = path.ancestors().collect();
    parts.into_iter().rev().find(is_new).unwrap_or(path)
}

/// Moves what a killed run did not, where everything is as that run found it.
pub fn complete(workplace: &Path, folder: &Path) {
    let (ready, was) = (workplace.join(READY), workplace.join(WAS));
    let hash = |path: &Path| digest::of_reader(regular::open(path).ok()?).ok();
    let mut left = Vec::new();
    if files(&ready, Path::new(""), &mut left).is_err() {
        return;
    }
    for path in left {
        let (place, before) = (folder.join(&path), was.join(&path));
        let is_there = |path: &Path| fs::symlink_metadata(path).is_ok();
        let is_as_before = match is_there(&place) {
            true => hash(&before).is_some() && hash(&before) == hash(&place),
            false => !is_there(&before),
        };
        let is_linked = path.ancestors().any(|part| folder.join(part).is_symlink());
        if is_as_before
            && !is_linked
            && let Some(above) = place.parent()
        {
            let _ = fs::create_dir_all(above).and_then(|()| fs::rename(ready.join(&path), &place));
        }
    }
}

/// The files in a folder, none of them behind a link.
fn files(folder: &Path, below: &Path, found: &mut Vec<PathBuf>) -> io::Result<()> {
    // `join` of nothing would end it with a slash, behind which a link is followed.
    let here = folder.components().chain(below.components()).collect::<PathBuf>();
    if !fs::symlink_metadata(&here)?.is_dir() {
        return Err(io::ErrorKind::NotADirectory.into());
    }
    for entry in fs::read_dir(here)? {
        let entry = entry?;
        let (path, kind) = (below.join(entry.file_name()), entry.file_type()?);
        if kind.is_dir() {
            files(folder, &path, found)?;
        } else if kind.is_file() {
            found.push(path);
        }
    }
    Ok(())
}
