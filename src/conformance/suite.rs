//! The suite as data: bases and cases.

use std::collections::BTreeMap;

use include_dir::Dir;

use super::case::Case;
use super::catalogue::URDD;
use super::data::{BASES, INVALID, SUITE};
use super::seal;
use super::tree::Tree;

/// Bases and cases.
#[derive(Debug, Clone, Default)]
pub struct Suite {
    /// URDDs that cases change, by name.
    pub bases: BTreeMap<String, Tree>,
    /// Cases, in order of code and name.
    pub cases: Vec<Case>,
}

/// Why the suite cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// A case is not what a case should be.
    #[error("{path}: {error}")]
    Case {
        /// Its file.
        path: String,
        /// Why.
        error: serde_json::Error,
    },
}

impl Suite {
    /// The suite that the program carries.
    ///
    /// # Errors
    /// Where a case cannot be read.
    pub fn carried() -> Result<Suite, SuiteError> {
        let mut suite = Suite::default();
        for base in SUITE.get_dir(BASES).into_iter().flat_map(Dir::dirs) {
            let name = base.path().file_name().unwrap_or_default();
            let mut tree =
                Tree::carried_around(&format!("{BASES}/{}", name.to_string_lossy()), URDD);
            seal::add_mirrors(&mut tree);
            suite
                .bases
                .insert(name.to_string_lossy().into_owned(), tree);
        }
        let codes = SUITE.get_dir(INVALID).into_iter().flat_map(Dir::dirs);
        for file in codes.flat_map(Dir::files) {
            let case = serde_json::from_slice(file.contents());
            suite.cases.push(case.map_err(|error| SuiteError::Case {
                path: file.path().display().to_string(),
                error,
            })?);
        }
        suite
            .cases
            .sort_by(|a, b| (&a.code, &a.name).cmp(&(&b.code, &b.name)));
        Ok(suite)
    }
}
