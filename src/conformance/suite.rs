//! The suite as data: bases and cases.

use std::collections::{BTreeMap, BTreeSet};

use super::case::Case;
use super::change::ChangeError;
use super::data::{self, BASES, DataError, INVALID, URDD};
use super::seal;
use super::tree::Tree;

/// Bases and cases.
#[derive(Debug, Clone, Default)]
pub struct Suite {
    /// The base URDDs of cases, by name.
    pub bases: BTreeMap<String, Tree>,
    /// Cases, in order of code and name.
    pub cases: Vec<Case>,
}

/// Why the suite cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// Its files cannot be read.
    #[error(transparent)]
    Data(#[from] DataError),
    /// A case file is invalid.
    #[error("{path}: {error}")]
    Case {
        /// Its file.
        path: String,
        /// Reason.
        error: serde_json::Error,
    },
}

/// Why a case cannot be built.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The base does not exist.
    #[error("{case}: there is no base {base:?}")]
    NoBase {
        /// The case.
        case: String,
        /// The base that it names.
        base: String,
    },
    /// A change does not apply.
    #[error("{case}: {error}")]
    Change {
        /// The case.
        case: String,
        /// Reason.
        error: ChangeError,
    },
}

impl Suite {
    /// The suite of this build.
    ///
    /// # Errors
    /// If a case cannot be read.
    pub fn carried() -> Result<Suite, SuiteError> {
        data::check()?;
        let mut suite = Suite::default();
        let bases: BTreeSet<&str> = data::below(BASES)
            .filter_map(|(path, _)| path.split('/').next())
            .collect();
        for base in bases {
            let mut tree = Tree::carried_around(&format!("{BASES}/{base}"), URDD);
            seal::add_mirrors(&mut tree);
            suite.bases.insert(base.to_owned(), tree);
        }
        for (path, text) in data::below(INVALID) {
            let case = serde_json::from_slice(text);
            suite.cases.push(case.map_err(|error| SuiteError::Case {
                path: format!("{INVALID}/{path}"),
                error,
            })?);
        }
        suite
            .cases
            .sort_by(|a, b| (&a.code, &a.name).cmp(&(&b.code, &b.name)));
        Ok(suite)
    }

    /// Builds the URDD of a case.
    ///
    /// # Errors
    /// If the base does not exist, or a change does not apply.
    pub fn tree(&self, case: &Case) -> Result<Tree, CaseError> {
        let base = self.bases.get(&case.base);
        let mut tree = base.cloned().ok_or_else(|| CaseError::NoBase {
            case: case.id(),
            base: case.base.clone(),
        })?;
        for change in &case.changes {
            change.apply(&mut tree).map_err(|error| CaseError::Change {
                case: case.id(),
                error,
            })?;
        }
        seal::rehash(&mut tree, &case.hashes_kept);
        Ok(tree)
    }
}
