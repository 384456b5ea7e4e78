//! Replaces the contents of a folder but keeps the folder itself, because it is in use as a current folder.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use urdd_directory::staging::inside::*;

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
