//! Whether the files of a robot changed: a word of their names, sizes and times.

use std::fs;
use std::path::Path;
use std::time::UNIX_EPOCH;

use sha2::{Digest, Sha256};

use crate::directory::limits::MAX_FILES;
use crate::format::hexadecimal::hexadecimal;

/// The word for a robot whose files are gone.
pub const GONE: &str = "gone";

/// A word that changes when a file below `path`, or the file at `path`, does. Links are not followed.
pub fn of(path: &Path) -> String {
    let mut lines = Vec::new();
    let mut waiting = vec![path.to_owned()];
    while let Some(at) = waiting.pop() {
        let metadata = match at == path {
            true => fs::metadata(&at),
            false => fs::symlink_metadata(&at),
        };
        let Ok(metadata) = metadata else {
            continue;
        };
        if metadata.is_dir() {
            let entries = fs::read_dir(&at).into_iter().flatten().flatten();
            waiting.extend(entries.map(|entry| entry.path()));
            continue;
        }
        if lines.len() > MAX_FILES {
            break;
        }
        let time = metadata.modified().ok();
        let time = time.and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        let name = at.strip_prefix(path).unwrap_or(&at).display().to_string();
        lines.push((name, metadata.len(), time.unwrap_or_default()));
    }
    if lines.is_empty() {
        return GONE.to_owned();
    }
    lines.sort();
    let mut hash = Sha256::new();
    for (name, size, time) in lines {
        hash.update(format!("{size} {} {name}\n", time.as_nanos()));
    }
    hexadecimal(&hash.finalize())
}

#[cfg(test)]
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
}
