//! Replaces the contents of a folder but keeps the folder itself, because it is in use as a current folder.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::Path;

use crate::discover::ROOT_METADATA;

/// Moves each entry of `content` into `target`, and the replaced ones into `old`. On failure, restores all of them.
/// Removes entries of `target` that `content` lacks. Moves `urdd.json` last: until then, the hashes show that the
/// folder is incomplete.
pub(super) fn put(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
    fs::create_dir(old)?;
    put_into(content, target, old)
}

fn put_into(content: &Path, target: &Path, old: &Path) -> io::Result<()> {
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
pub(super) fn put_back(old: &Path, target: &Path) -> io::Result<()> {
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().expect("a parent")).expect("a folder");
            fs::write(path, text).expect("written");
        }
        folder
    }

    fn content(folder: &Path) -> BTreeMap<String, String> {
        let mut found = BTreeMap::new();
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            match entry.path().is_dir() {
                true => found.extend(
                    content(&entry.path())
                        .into_iter()
                        .map(|(inner, text)| (format!("{name}/{inner}"), text)),
                ),
                false => {
                    let text = fs::read_to_string(entry.path()).expect("text");
                    found.insert(name, text);
                }
            }
        }
        found
    }

    #[test]
    fn the_folder_stays_and_its_content_is_new() {
        let target = folder(&[("a/x", "1"), ("urdd.json", "1"), ("gone", "1")]);
        let new = folder(&[("a/x", "2"), ("b", "2"), ("urdd.json", "2")]);
        let expected = content(new.path());
        let old = folder(&[]);
        let old = old.path().join("old");
        put(new.path(), target.path(), &old).expect("put");
        assert_eq!(content(target.path()), expected);
        assert!(!old.exists());
    }

    #[test]
    fn what_cannot_be_put_leaves_everything_as_it_was() {
        let target = folder(&[("a/x", "1"), ("b/x", "1"), ("urdd.json", "1")]);
        let before = content(target.path());
        let new = folder(&[("a/x", "2"), ("b/x", "2"), ("urdd.json", "2")]);
        // A non-empty folder occupies the path to which the old `b` would move.
        let old = folder(&[("b/occupied", "")]);
        let taken = old.path().to_owned();
        let done = put_into(new.path(), target.path(), &taken);
        assert!(done.is_err());
        assert_eq!(content(target.path()), before);
    }

    #[test]
    fn a_run_that_ended_in_the_middle_is_put_back() {
        let target = folder(&[("a/x", "2")]);
        let old = folder(&[("a/x", "1"), ("urdd.json", "1")]);
        put_back(old.path(), target.path()).expect("put back");
        let expected = [("a/x", "2"), ("urdd.json", "1")];
        let expected = expected.map(|(name, text)| (name.to_owned(), text.to_owned()));
        assert_eq!(content(target.path()), BTreeMap::from(expected));
    }
}
