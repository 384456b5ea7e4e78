//! The names in a .zip that is dropped on the page, whatever program packed it.

use std::collections::BTreeSet;

use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_directory::source::Archive;
use urdd_source::Files;

/// Each name is a path inside of the archive, and is there once. Each file is read by its name, and found by it among
/// the files of a drop.
pub fn archive_names(bytes: &[u8]) {
    let archive = match Archive::of_any("robot", bytes.to_vec()) {
        Ok(archive) => archive,
        Err(fault) => {
            assert!(!fault.to_string().is_empty());
            return;
        }
    };
    let root = Root::of(archive);
    let mut names = BTreeSet::new();
    let mut files = Vec::new();
    for entry in root.list().expect("a listing").entries {
        assert!(names.insert(entry.path.clone()), "{} is there twice", entry.path);
        assert!(
            entry.path.split('/').all(|part| !matches!(part, "" | "." | "..")),
            "{}",
            entry.path
        );
        let is_named = urdd_directory::path::check(&entry.path).is_ok() && entry.utf8;
        if entry.kind == EntryKind::File && is_named {
            let read = root.read(&entry.path, entry.size).expect("a file");
            assert_eq!(read.len() as u64, entry.size);
            files.push((entry.path, read));
        }
    }
    let sizes = files.iter().map(|(path, read)| (path.clone(), read.len() as u64));
    if let Ok(found) = Files::of(root, "drop", sizes) {
        for (name, content) in &files {
            let path = std::path::Path::new("/drop").join(name);
            let read = found.read(&path, content.len() as u64).expect("a file");
            assert_eq!(read, *content, "{name}");
        }
    }
}
