//! Detects changes of a robot's files by a fingerprint of their names, sizes and times. On Unix it includes what
//! programs cannot reset: the time of the last status change (ctime), and the inode number.

use std::fs::{self, Metadata};
use std::path::Path;
use std::time::UNIX_EPOCH;

use sha2::{Digest, Sha256};

use urdd_directory::limits::MAX_FILES;
use urdd_directory::source::Stamp;
use urdd_format::hexadecimal::hexadecimal;

/// The fingerprint of a robot whose files no longer exist.
pub const GONE: &str = "gone";

/// A fingerprint that changes when a file below `path`, or the file at `path`, changes. Does not follow symbolic links.
/// A new hard link to a file is a change too.
pub fn of(path: &Path) -> String {
    word(path, &|metadata| format!("{:?}", Stamp::of(metadata)))
}

/// As [`of`], but from names, sizes and times only: a new hard link is not a change.
pub fn of_content(path: &Path) -> String {
    word(path, &|_| String::new())
}

/// As [`of`], for one file: a folder is not searched.
pub fn of_file(path: &Path) -> String {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_file() => of(path),
        Ok(_) => "no file".to_owned(),
        Err(_) => GONE.to_owned(),
    }
}

fn word(path: &Path, changed: &dyn Fn(&Metadata) -> String) -> String {
    let mut lines = Vec::new();
    let mut waiting = vec![path.to_owned()];
    while let Some(at) = waiting.pop() {
        let read = if at == path { fs::metadata(&at) } else { fs::symlink_metadata(&at) };
        let Ok(metadata) = read else { continue };
        if metadata.is_dir() {
            let entries = fs::read_dir(&at).into_iter().flatten().flatten();
            waiting.extend(entries.map(|entry| entry.path()));
            continue;
        }
        if lines.len() > MAX_FILES {
            break;
        }
        let time = metadata.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        let name = at.strip_prefix(path).unwrap_or(&at).display().to_string();
        let nanoseconds = time.unwrap_or_default().as_nanos();
        lines.push((name, metadata.len(), nanoseconds, changed(&metadata)));
    }
    if lines.is_empty() {
        return GONE.to_owned();
    }
    lines.sort();
    let mut hash = Sha256::new();
    for (name, size, time, changed) in lines {
        hash.update(format!("{size} {time} {changed} {name}\n"));
    }
    hexadecimal(&hash.finalize())
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)]
mod tests {
    use super::*;

    #[test]
    fn a_change_of_any_file_changes_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("robot");
        assert_eq!(of(&path), GONE);
        fs::create_dir_all(path.join("a")).expect("a folder");
        fs::write(path.join("a/x"), "1").expect("a file");
        let one = of(&path);
        assert_eq!(one, of(&path));
        fs::write(path.join("a/y"), "").expect("a file");
        let two = of(&path);
        fs::write(path.join("a/x"), "12").expect("a file");
        let three = of(&path);
        assert!(one != two && two != three && three != one && three != GONE);
    }

    #[cfg(unix)]
    #[test]
    fn a_change_that_keeps_size_and_time_changes_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let (path, other) = (folder.path().join("robot"), folder.path().join("other"));
        fs::create_dir(&path).expect("a folder");
        let file = path.join("x");
        fs::write(&file, "1").expect("a file");
        let time = fs::metadata(&file).and_then(|metadata| metadata.modified());
        let time = time.expect("a time");
        let (one, content) = (of(&path), of_content(&path));
        fs::write(&file, "2").expect("a file");
        let written = fs::File::options().write(true).open(&file).expect("it");
        written.set_modified(time).expect("set");
        let two = of(&path);
        assert_ne!(one, two, "written in place");
        assert_eq!(content, of_content(&path), "this is what it guards against");
        fs::write(&other, "3").expect("a file");
        let written = fs::File::options().write(true).open(&other).expect("it");
        written.set_modified(time).expect("set");
        fs::rename(&other, &file).expect("renamed");
        assert_ne!(two, of(&path), "another file in its place");
    }
}
