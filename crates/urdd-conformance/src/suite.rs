//! The suite as data: bases and cases.

use std::collections::{BTreeMap, BTreeSet};

use crate::case::{Case, RuleCases};
use crate::change::ChangeError;
use crate::data::{BASES, CASES, COMPUTED, CopiesError, Data, Files, URDD};
use crate::seal;
use crate::tree::Tree;

/// Bases and cases.
#[derive(Debug, Clone)]
pub struct Suite {
    /// All files.
    pub data: Data,
    /// The base URDDs of cases, by name.
    pub bases: BTreeMap<String, Tree>,
    /// Cases, in order of code and name.
    pub cases: Vec<Case>,
}

/// Why the suite cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum SuiteError {
    /// A list of equal files is damaged.
    #[error(transparent)]
    Copies(#[from] CopiesError),
    /// A file of cases is invalid.
    #[error("{path}: {error}")]
    Cases {
        /// The file.
        path: String,
        /// Reason.
        error: serde_json::Error,
    },
    /// Two cases of a rule have the same name.
    #[error("{0}: two cases have this name")]
    Twice(String),
}

/// Why a case cannot be built.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The base does not exist.
    #[error("{case}: there is no base {base:?}; `bases/` has {known}")]
    NoBase {
        /// The case.
        case: String,
        /// The base that it names.
        base: String,
        /// The bases.
        known: String,
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
    /// The suite that these files describe.
    ///
    /// # Errors
    /// If a case cannot be read.
    pub fn of(files: Files) -> Result<Suite, SuiteError> {
        let data = Data::of(files)?;
        let names = data.below(BASES);
        let names: BTreeSet<&str> = names.filter_map(|(path, _)| path.split('/').next()).collect();
        let base = |name: &str| {
            let files = data.below(&format!("{BASES}/{name}"));
            let mut tree = Tree::of(files, URDD);
            seal::add_mirrors(&mut tree);
            (name.to_owned(), tree)
        };
        let bases = names.into_iter().map(base).collect();
        let mut cases = Vec::new();
        for folder in [CASES, COMPUTED] {
            for (name, text) in data.below(folder) {
                let rule: RuleCases = serde_json::from_slice(text).map_err(|error| {
                    SuiteError::Cases { path: format!("{folder}/{name}"), error }
                })?;
                cases.extend(rule.cases(name.trim_end_matches(".json")));
            }
        }
        cases.sort_by(|a, b| (&a.code, &a.name).cmp(&(&b.code, &b.name)));
        let mut pairs = cases.iter().zip(cases.iter().skip(1));
        match pairs.find(|(one, next)| (&one.code, &one.name) == (&next.code, &next.name)) {
            Some((one, _)) => Err(SuiteError::Twice(one.id())),
            None => Ok(Suite { data, bases, cases }),
        }
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
            known: self.bases.keys().cloned().collect::<Vec<_>>().join(", "),
        })?;
        for change in &case.changes {
            change
                .apply(&mut tree)
                .map_err(|error| CaseError::Change { case: case.id(), error })?;
        }
        seal::rehash(&mut tree, &case.hashes_kept);
        Ok(tree)
    }
}
