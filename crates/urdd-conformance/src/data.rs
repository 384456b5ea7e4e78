//! The suite's files: whoever runs it brings them, as `conformance/` of the repository has them. And the valid URDDs that
//! `urdd generate` writes for the suite's robots: stored are `urdd.json`, which has the sizes and hashes of all other files,
//! and small documents.

use std::collections::BTreeMap;
use std::path::Path;

use crate::tree::{FilePath, Node, Tree, TreeError};
use urdd_directory::discover::ROOT_METADATA;

/// Files by path, with forward slashes.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The robots to run producers on: URDF files, with their meshes below.
pub const ROBOTS: &str = "robots";
/// Robots with loops, for producers of `loops_module`: URDF+ files, each with a list of what closes its loops.
pub const LOOPED: &str = "looped";
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

/// Size limit of stored documents, bytes.
const LARGEST_KEPT: usize = 64 * 1024;

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

    /// Names of the suite's robots, sorted.
    pub fn robots(&self) -> Vec<String> {
        self.urdfs(ROBOTS)
    }

    /// Names of the robots with loops, sorted.
    pub fn looped(&self) -> Vec<String> {
        self.urdfs(LOOPED)
    }

    fn urdfs(&self, folder: &str) -> Vec<String> {
        let names = self.below(folder).filter_map(|(path, _)| path.strip_suffix(".urdf"));
        names.filter(|name| !name.contains('/')).map(str::to_owned).collect()
    }

    /// Writes the URDFs of the robots with loops into a folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write_looped(&self, folder: &Path) -> Result<(), TreeError> {
        let urdfs = self.below(LOOPED).filter(|(path, _)| path.ends_with(".urdf"));
        Tree::of(urdfs, "").write(folder)
    }

    /// Writes the robots into a folder: the URDFs and the files that they name.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write_robots(&self, folder: &Path) -> Result<(), TreeError> {
        let mut tree = Tree::of(self.below(ROBOTS), "");
        // Leave out the scripts that generate the robots.
        let scripts = FilePath::from("make");
        tree.nodes.retain(|path, _| !path.is_within(&scripts));
        tree.write(folder)
    }

    /// The stored part of a robot's valid URDD.
    pub fn carried(&self, robot: &str) -> Tree {
        Tree::of(self.below(&valid_id(robot)), "")
    }
}

/// The id of a robot's valid URDD, which is also its folder in the suite.
pub fn valid_id(robot: &str) -> String {
    format!("{VALID}/{robot}")
}

/// The part of a valid URDD that the repository stores.
pub fn kept(urdd: &Tree) -> Tree {
    let is_kept = |path: &FilePath, node: &Node| {
        let path = path.as_str().unwrap_or_default();
        let small = matches!(node, Node::File(bytes) if bytes.len() <= LARGEST_KEPT);
        path == ROOT_METADATA || small && path.ends_with("/module.json")
    };
    let mut kept = urdd.clone();
    kept.nodes.retain(|path, node| is_kept(path, node));
    kept
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
