//! The suite's files: whoever runs it brings them, as `conformance/` of the repository has them.

use std::collections::BTreeMap;

/// Files by path, with forward slashes.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The robots to run producers on: URDF files, with their meshes below.
pub const ROBOTS: &str = "robots";
/// The stored part of the URDDs that `urdd generate` writes for these robots.
pub const VALID: &str = "valid";
/// The base URDDs of cases: one folder each.
pub const BASES: &str = "bases";
/// Files of bases that equal another base's file: both paths relative to [`BASES`]. Only the other file is stored.
pub const COPIES: &str = "bases/copies.json";
/// Cases that people write, including near misses: one file per code.
pub const CASES: &str = "cases";
/// Cases that the tests of rules compute, in the same form.
pub const COMPUTED: &str = "computed";
/// Cases in an exported suite: one folder per code.
pub const INVALID: &str = "invalid";
/// Cases about what cannot be read: one file per clause. Also their folder in an exported suite, and what their ids begin
/// with.
pub const UNREADABLE: &str = "unreadable";
/// The URDD's folder within its case's folder; other files may be beside it.
pub const URDD: &str = "robot";
/// The URDD in place of [`URDD`], where a case has it as a zip archive.
pub const PACKED: &str = "robot.zip";
/// Numeric reference values.
pub const VECTORS: &str = "vectors";

/// What is wrong with the suite.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct Damage {
    /// The file or the case.
    pub place: String,
    /// What is wrong there.
    pub reason: String,
}

impl Damage {
    pub(crate) fn new(place: impl Into<String>, reason: impl ToString) -> Self {
        Damage { place: place.into(), reason: reason.to_string() }
    }
}

/// The suite's files, those of [`COPIES`] too.
#[derive(Debug, Clone)]
pub struct Data(Files);

impl Data {
    /// Replaces [`COPIES`] by the files that it lists: the suite stores equal files of bases once.
    ///
    /// # Errors
    /// If the list is damaged, or the stored file is missing.
    pub fn of(mut files: Files) -> Result<Data, Damage> {
        let list = files.remove(COPIES).unwrap_or_else(|| b"{}".to_vec());
        let copies: BTreeMap<String, String> =
            serde_json::from_slice(&list).map_err(|error| Damage::new(COPIES, error))?;
        for (copy, stored) in copies {
            let missing =
                || Damage::new(COPIES, format!("{stored} is missing, which {copy} equals"));
            let bytes = files.get(&format!("{BASES}/{stored}")).cloned().ok_or_else(missing)?;
            files.insert(format!("{BASES}/{copy}"), bytes);
        }
        Ok(Data(files))
    }

    /// The files in a folder of the suite, with their paths relative to that folder.
    pub fn below<'a>(
        &'a self,
        folder: &str,
    ) -> impl Iterator<Item = (&'a str, &'a [u8])> + use<'a> {
        let start = format!("{folder}/");
        let files = self.0.iter();
        files.filter_map(move |(path, bytes)| Some((path.strip_prefix(&start)?, bytes.as_slice())))
    }

    /// A file of the suite.
    pub fn file(&self, path: &str) -> Option<&[u8]> {
        self.0.get(path).map(Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_files_and_need_a_stored_one() {
        let files = |stored: &str| {
            let list = format!(r#"{{"b/robot/x": "{stored}"}}"#);
            [(COPIES, list.as_str()), ("bases/a/robot/x", "1"), ("bases/b/robot/y", "2")]
                .map(|(path, text)| (path.to_owned(), text.as_bytes().to_vec()))
        };
        let all = Data::of(files("a/robot/x").into()).expect("a stored file");
        let paths: Vec<&str> = all.below(BASES).map(|(path, _)| path).collect();
        assert_eq!(paths, ["a/robot/x", "b/robot/x", "b/robot/y"]);
        assert_eq!(all.file("bases/b/robot/x"), Some(b"1".as_slice()));
        let error = Data::of(files("a/robot/z").into()).expect_err("nothing is stored there");
        let error = error.to_string();
        assert!(error.contains("a/robot/z is missing"), "{error}");
    }
}
