//! The suite as data: bases and cases.

use std::collections::{BTreeMap, BTreeSet};

use crate::case::{Case, RuleCases, UnreadableCases};
use crate::change::{add_mirrors, rehash};
use crate::data::{BASES, CASES, COMPUTED, Damage, Data, Files, UNREADABLE, URDD};
use crate::tree::Tree;

/// Bases and cases.
#[derive(Debug, Clone)]
pub struct Suite {
    /// All files.
    pub data: Data,
    /// The base URDDs of cases, by name.
    pub bases: BTreeMap<String, Tree>,
    /// Cases of rules, in order of code and name.
    pub cases: Vec<Case>,
    /// Cases about what cannot be read, in order of name.
    pub unreadable: Vec<Case>,
}

impl Suite {
    /// The suite that these files describe.
    ///
    /// # Errors
    /// If a case cannot be read.
    pub fn of(files: Files) -> Result<Suite, Damage> {
        let data = Data::of(files)?;
        let names = data.below(BASES);
        let names: BTreeSet<&str> = names.filter_map(|(path, _)| path.split('/').next()).collect();
        let base = |name: &str| {
            let files = data.below(&format!("{BASES}/{name}"));
            let mut tree = Tree::of(files, URDD);
            add_mirrors(&mut tree);
            (name.to_owned(), tree)
        };
        let bases = names.into_iter().map(base).collect();
        let mut cases = Vec::new();
        for folder in [CASES, COMPUTED] {
            for (name, text) in data.below(folder) {
                let rule: RuleCases = serde_json::from_slice(text)
                    .map_err(|error| Damage::new(format!("{folder}/{name}"), error))?;
                cases.extend(rule.cases(name.trim_end_matches(".json")));
            }
        }
        let mut unreadable = Vec::new();
        for (name, text) in data.below(UNREADABLE) {
            let clause: UnreadableCases = serde_json::from_slice(text)
                .map_err(|error| Damage::new(format!("{UNREADABLE}/{name}"), error))?;
            unreadable.extend(clause.cases());
        }
        for cases in [&mut cases, &mut unreadable] {
            cases.sort_by(|a, b| (&a.code, &a.name).cmp(&(&b.code, &b.name)));
            let mut pairs = cases.iter().zip(cases.iter().skip(1));
            let twice =
                pairs.find(|(one, next)| (&one.code, &one.name) == (&next.code, &next.name));
            if let Some((one, _)) = twice {
                return Err(Damage::new(one.id(), "two cases have this name"));
            }
        }
        Ok(Suite { data, bases, cases, unreadable })
    }

    /// The cases of rules, then those about what cannot be read.
    pub fn all_cases(&self) -> impl Iterator<Item = &Case> {
        self.cases.iter().chain(&self.unreadable)
    }

    /// Builds the URDD of a case.
    ///
    /// # Errors
    /// If the base does not exist, or a change does not apply.
    pub fn tree(&self, case: &Case) -> Result<Tree, Damage> {
        let mut tree = self.bases.get(&case.base).cloned().ok_or_else(|| {
            let known = self.bases.keys().cloned().collect::<Vec<_>>().join(", ");
            let reason = format!("there is no base {:?}; `bases/` has {known}", case.base);
            Damage::new(case.id(), reason)
        })?;
        for change in &case.changes {
            let misfit = |error| Damage::new(case.id(), format!("{}: {error}", change.file));
            change.apply(&mut tree).map_err(misfit)?;
        }
        rehash(&mut tree, &case.hashes_kept);
        Ok(tree)
    }
}
