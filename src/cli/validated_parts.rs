//! Remembers which parts this program found free of errors, so that combining them again does not validate them again.
//!
//! The memory is a file in the user's cache folder: one hash a line, of the program and of all that validation reads.
//! It is never part of a URDD. Without it, or if it cannot be read or written, parts are validated.

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use rayon::prelude::*;
use sha2::{Digest, Sha256};
use urdd_directory::cancellation::Cancelled;
use urdd_directory::digest;
use urdd_directory::layout::ROOT_METADATA;
use urdd_directory::regular;
use urdd_directory::root::{EntryKind, Root};

/// Number of parts that are remembered.
const MAX_PARTS: usize = 1000;

/// Maximum size of the file: a hash and a line end for each part.
const MAX_BYTES: u64 = 65 * MAX_PARTS as u64;

/// The parts that passed.
pub(super) struct ValidatedParts {
    /// `None` if nothing is remembered.
    file: Option<PathBuf>,
}

impl ValidatedParts {
    /// In the user's cache folder, by the variables of the environment.
    pub(super) fn new(variable: impl Fn(&str) -> Option<OsString>) -> Self {
        let folder = cache_folder(variable);
        let file = folder.map(|folder| folder.join("urdd").join("validated_parts.txt"));
        ValidatedParts { file }
    }

    /// Remembers nothing.
    pub(super) fn none() -> Self {
        ValidatedParts { file: None }
    }

    /// The errors of a part. `find_errors` is not called if the part passed before.
    pub(super) fn find_errors(
        &self,
        part: &Path,
        find_errors: impl FnOnce(&Path) -> Result<Vec<String>, Cancelled>,
    ) -> Result<Vec<String>, Cancelled> {
        let Some(file) = &self.file else {
            return find_errors(part);
        };
        let key = key(part);
        let passed = read(file);
        if key.as_ref().is_some_and(|key| passed.contains(key)) {
            return Ok(Vec::new());
        }
        let errors = find_errors(part)?;
        // Only what was the same before and after the validation was validated.
        if errors.is_empty()
            && let Some(key) = key.filter(|before| self::key(part).as_ref() == Some(before))
        {
            remember(file, passed, key);
        }
        Ok(errors)
    }
}

/// The user's folder for caches; as the XDG Base Directory Specification says, relative paths are ignored.
fn cache_folder(variable: impl Fn(&str) -> Option<OsString>) -> Option<PathBuf> {
    let absolute = |name: &str| {
        let path = PathBuf::from(variable(name)?);
        path.is_absolute().then_some(path)
    };
    let usual = || match () {
        () if cfg!(windows) => absolute("LOCALAPPDATA"),
        () if cfg!(target_os = "macos") => Some(absolute("HOME")?.join("Library/Caches")),
        () => Some(absolute("HOME")?.join(".cache")),
    };
    absolute("XDG_CACHE_HOME").or_else(usual)
}

/// The hash of this program and of all that validation reads of a part. `None` for a legacy URDD, which may name files
/// beside its folder, and for one with something else than files and folders in it.
fn key(part: &Path) -> Option<String> {
    let root = Root::open(part).ok()?;
    let listing = root.list().ok()?;
    let whole = !listing.cut && listing.unreadable.is_empty() && listing.has_file(ROOT_METADATA);
    if !whole {
        return None;
    }
    let each = listing.entries.par_iter().map(|entry| match entry.kind {
        _ if !entry.utf8 => None,
        EntryKind::Folder => Some(format!("{:?}\n", entry.path)),
        EntryKind::File => {
            let (size, hash) = digest::of(&root, &entry.path).ok()?;
            Some(format!("{:?} {size} {hash}\n", entry.path))
        }
        _ => None,
    });
    let lines: Vec<String> = each.collect::<Option<_>>()?;
    let mut hasher = Sha256::new();
    hasher.update(program()?);
    hasher.update(format!("{:?}\n", root.folder_name()));
    lines.iter().for_each(|line| hasher.update(line));
    Some(digest::of_bytes(&hasher.finalize()).1)
}

/// What is different for another build of this program.
fn program() -> Option<String> {
    let metadata = fs::metadata(std::env::current_exe().ok()?).ok()?;
    let written = metadata.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
    let (version, size) = (env!("CARGO_PKG_VERSION"), metadata.len());
    Some(format!("urdd {version} {size} {}\n", written.as_nanos()))
}

/// The hashes in a file, the oldest first; none if it is missing, too long or not such a file.
fn read(file: &Path) -> Vec<String> {
    let bytes = regular::read(file, MAX_BYTES).unwrap_or_default();
    let text = String::from_utf8(bytes).unwrap_or_default();
    text.lines().map(str::to_owned).collect()
}

/// Adds a hash and drops the oldest. Replaces the file atomically; if that fails, the part is validated again.
fn remember(file: &Path, mut passed: Vec<String>, key: String) {
    passed.push(key);
    let newest = passed.len().saturating_sub(MAX_PARTS);
    let text: String = passed[newest..].iter().map(|key| format!("{key}\n")).collect();
    let write = || -> Option<()> {
        let folder = file.parent()?;
        fs::create_dir_all(folder).ok()?;
        let mut new = tempfile::NamedTempFile::new_in(folder).ok()?;
        new.write_all(text.as_bytes()).ok()?;
        new.persist(file).ok()?;
        Some(())
    };
    write();
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    fn parts_in(folder: &Path) -> ValidatedParts {
        let folder = folder.join("cache");
        ValidatedParts::new(move |name| (name == "XDG_CACHE_HOME").then(|| folder.clone().into()))
    }

    fn part_in(folder: &Path) -> PathBuf {
        let part = folder.join("part");
        fs::create_dir_all(part.join("m")).unwrap();
        fs::write(part.join(ROOT_METADATA), "{}").unwrap();
        fs::write(part.join("m/module.json"), "{}").unwrap();
        part
    }

    /// Whether a part is validated, with this outcome.
    fn is_validated(parts: &ValidatedParts, part: &Path, errors: &[&str]) -> bool {
        let called = Cell::new(false);
        let found = parts.find_errors(part, |_| {
            called.set(true);
            Ok(errors.iter().map(|e| (*e).to_owned()).collect())
        });
        let expected = if called.get() { errors } else { &[] };
        assert_eq!(found.unwrap(), expected);
        called.get()
    }

    #[test]
    fn a_part_that_passed_is_not_validated_again_until_something_in_it_changes() {
        let folder = tempfile::tempdir().unwrap();
        let (parts, part) = (parts_in(folder.path()), part_in(folder.path()));
        let file = folder.path().join("cache/urdd/validated_parts.txt");
        let is_new = || is_validated(&parts, &part, &[]);
        assert!(is_validated(&parts, &part, &["DIR001"]) && !file.exists());
        assert!(is_new() && !is_new());
        fs::write(part.join("m/module.json"), "[]").unwrap();
        assert!(is_new() && !is_new());
        fs::rename(part.join("m/module.json"), part.join("m/other.json")).unwrap();
        assert!(is_new() && !is_new());
        fs::create_dir(part.join("n")).unwrap();
        assert!(is_new() && !is_new());
        fs::remove_dir(part.join("n")).unwrap();
        assert!(!is_new());
        // A copy is the same part if its folder has the same name.
        let copy = part_in(&folder.path().join("copy"));
        fs::rename(copy.join("m/module.json"), copy.join("m/other.json")).unwrap();
        fs::write(copy.join("m/other.json"), "[]").unwrap();
        assert!(!is_validated(&parts, &copy, &[]));
        fs::rename(&copy, folder.path().join("copy/other")).unwrap();
        assert!(is_validated(&parts, &folder.path().join("copy/other"), &[]));
        let nothing = ValidatedParts::none();
        assert!(is_validated(&nothing, &part, &[]) && is_validated(&nothing, &part, &[]));
    }

    #[test]
    fn what_changes_while_it_is_validated_or_is_a_legacy_urdd_is_not_remembered() {
        let folder = tempfile::tempdir().unwrap();
        let (parts, part) = (parts_in(folder.path()), part_in(folder.path()));
        let change = |_: &Path| {
            fs::write(part.join("m/module.json"), "[1]").unwrap();
            Ok(Vec::new())
        };
        parts.find_errors(&part, change).unwrap();
        assert!(is_validated(&parts, &part, &[]) && !is_validated(&parts, &part, &[]));
        fs::remove_file(part.join(ROOT_METADATA)).unwrap();
        assert!(is_validated(&parts, &part, &[]) && is_validated(&parts, &part, &[]));
    }

    #[test]
    fn a_cache_that_cannot_be_used_is_no_error() {
        let folder = tempfile::tempdir().unwrap();
        let (parts, part) = (parts_in(folder.path()), part_in(folder.path()));
        let cache = folder.path().join("cache");
        // A file in the place of the folder, a folder in the place of the file, and bytes that are no text.
        fs::write(&cache, "").unwrap();
        assert!(is_validated(&parts, &part, &[]) && is_validated(&parts, &part, &[]));
        fs::remove_file(&cache).unwrap();
        let file = cache.join("urdd/validated_parts.txt");
        fs::create_dir_all(&file).unwrap();
        assert!(is_validated(&parts, &part, &[]) && is_validated(&parts, &part, &[]));
        fs::remove_dir(&file).unwrap();
        fs::write(&file, [0xff; 100]).unwrap();
        assert!(is_validated(&parts, &part, &[]) && !is_validated(&parts, &part, &[]));
        assert_eq!(fs::read_dir(cache.join("urdd")).unwrap().count(), 1);
    }

    #[test]
    fn the_file_does_not_grow_without_end() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("parts.txt");
        let hash = |n: usize| format!("{n:064}");
        let all: Vec<String> = (0..MAX_PARTS).map(hash).collect();
        remember(&file, all.clone(), hash(MAX_PARTS));
        let kept = read(&file);
        assert_eq!((kept.len(), &kept[..2]), (MAX_PARTS, &all[1..3]));
        fs::write(&file, "a\n".repeat(MAX_BYTES as usize)).unwrap();
        assert_eq!(read(&file), Vec::<String>::new());
    }

    #[test]
    fn the_cache_is_in_the_users_folder() {
        let of = |pairs: &'static [(&str, &str)]| {
            cache_folder(move |name| {
                let value = pairs.iter().find(|pair| pair.0 == name)?.1;
                Some(value.into())
            })
        };
        if cfg!(target_os = "linux") {
            assert_eq!(of(&[("HOME", "/home/a")]), Some("/home/a/.cache".into()));
            assert_eq!(of(&[("XDG_CACHE_HOME", "/c"), ("HOME", "/home/a")]), Some("/c".into()));
            assert_eq!(
                of(&[("XDG_CACHE_HOME", "c"), ("HOME", "/home/a")]),
                Some("/home/a/.cache".into())
            );
        }
        assert_eq!(of(&[]), None);
    }
}
