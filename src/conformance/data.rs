//! The suite's files. A release build embeds them as an archive; a debug build reads them from the repository, so that
//! new cases need no rebuild.

use std::collections::BTreeMap;
#[cfg(any(test, suite_in_repository))]
use std::path::Path;
use std::sync::LazyLock;

use super::archive::{self, Files};

/// The suite's files by path.
#[cfg(not(suite_in_repository))]
fn read() -> Result<Files, String> {
    let archive = include_bytes!(concat!(env!("OUT_DIR"), "/suite.tar.gz"));
    archive::unpack(archive).map_err(|error| error.to_string())
}

/// The suite's files by path.
#[cfg(suite_in_repository)]
fn read() -> Result<Files, String> {
    archive::read_folder(Path::new(REPOSITORY))
        .map_err(|error| format!("{error}; a debug build reads it from the repository"))
}

/// The suite's folder in the repository.
#[cfg(any(test, suite_in_repository))]
const REPOSITORY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/conformance");

/// The robots to run producers on: URDF files, with their meshes below.
pub const ROBOTS: &str = "robots";
/// The stored part of the URDDs that `urdd generate` writes for these robots.
pub const VALID: &str = "valid";
/// The base URDDs of cases: one folder each.
pub const BASES: &str = "bases";
/// Files of bases that equal another base's file: both paths relative to [`BASES`]. Only the other file is stored.
pub const COPIES: &str = "bases/copies.json";
/// Cases, including near misses: one folder per code.
pub const INVALID: &str = "invalid";
/// The URDD's folder within its case's folder; other files may be beside it.
pub const URDD: &str = "robot";
/// Numeric reference values.
pub const VECTORS: &str = "vectors";

/// The suite cannot be read.
#[derive(Debug, Clone, thiserror::Error)]
#[error("the conformance suite cannot be read: {0}")]
pub struct DataError(String);

static SUITE: LazyLock<Result<Files, DataError>> =
    LazyLock::new(|| read().and_then(with_copies).map_err(DataError));

/// Replaces [`COPIES`] by the files that it lists: the suite stores equal files of bases once.
fn with_copies(mut files: Files) -> Result<Files, String> {
    let list = files.remove(COPIES).unwrap_or_else(|| b"{}".to_vec());
    let copies: BTreeMap<String, String> =
        serde_json::from_slice(&list).map_err(|error| format!("{COPIES}: {error}"))?;
    for (copy, stored) in copies {
        let bytes = files.get(&format!("{BASES}/{stored}")).cloned();
        let bytes = bytes.ok_or(format!(
            "{COPIES}: {stored} is missing, which {copy} equals"
        ))?;
        files.insert(format!("{BASES}/{copy}"), bytes);
    }
    Ok(files)
}

/// Checks that the suite can be read. If it cannot, [`below`] returns nothing.
///
/// # Errors
/// Why it cannot be read.
pub fn check() -> Result<(), DataError> {
    SUITE.as_ref().map(|_| ()).map_err(Clone::clone)
}

/// The files in a folder of the suite, with their paths relative to that folder.
pub fn below(folder: &str) -> impl Iterator<Item = (&'static str, &'static [u8])> {
    let files: &'static Result<Files, DataError> = &SUITE;
    let start = format!("{folder}/");
    let files = files.iter().flat_map(|files| files.iter());
    files.filter_map(move |(path, bytes)| Some((path.strip_prefix(&start)?, bytes.as_slice())))
}

/// A file of the suite.
pub fn file(path: &str) -> Option<&'static [u8]> {
    let files: &'static Result<Files, DataError> = &SUITE;
    files.as_ref().ok()?.get(path).map(Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_archive_holds_what_the_folder_holds() {
        let files = archive::read_folder(Path::new(REPOSITORY)).expect("the repository's");
        let cases = files.keys().filter(|path| path.starts_with("invalid/"));
        assert!(cases.count() > 500, "{} files", files.len());
        let packed = archive::pack(&files).expect("an archive");
        assert_eq!(archive::unpack(&packed).expect("what was packed"), files);
        assert_eq!(archive::pack(&files).expect("the same again"), packed);
        // The archive adds about 0.8 MB to the program.
        assert!(packed.len() < 1_500_000, "{} bytes", packed.len());
        assert!(archive::unpack(&packed[..packed.len() / 2]).is_err());
    }

    #[test]
    fn copies_are_files_and_need_a_stored_one() {
        let files = |stored: &str| {
            let list = format!(r#"{{"b/robot/x": "{stored}"}}"#);
            [
                (COPIES, list.as_str()),
                ("bases/a/robot/x", "1"),
                ("bases/b/robot/y", "2"),
            ]
            .map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec()))
        };
        let all = with_copies(files("a/robot/x").into()).expect("a stored file");
        let paths: Vec<&String> = all.keys().collect();
        assert_eq!(
            paths,
            ["bases/a/robot/x", "bases/b/robot/x", "bases/b/robot/y"]
        );
        assert_eq!(all["bases/b/robot/x"], b"1");
        let error = with_copies(files("a/robot/z").into()).expect_err("nothing is stored there");
        assert!(error.contains("a/robot/z is missing"), "{error}");
    }

    #[test]
    fn files_are_found_by_folder() {
        assert!(check().is_ok());
        assert!(file("README.md").is_some() && file("no/such").is_none());
        let mut robots = below(ROBOTS).map(|(path, _)| path);
        assert!(robots.any(|path| path == "gripper.urdf"));
        assert_eq!(below("no_such").count(), 0);
    }
}
