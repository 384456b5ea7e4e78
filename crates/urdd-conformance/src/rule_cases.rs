//! The cases of a rule as the suite stores them: a file a rule, written by people or by the tests of rules.

use std::collections::BTreeSet;

use semver::VersionReq;
use serde::Deserialize;

use crate::archive::Packed;
use crate::case::{Case, Expected, Kind, Verdict};
use crate::change::Change;

/// The versions of the specification to which cases apply that name none.
const SPEC_VERSIONS: &str = ">=1.0.0, <2.0.0";

/// A file of cases.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RuleCases {
    /// Name of the rule.
    rule: String,
    /// What a validator must say of the invalid cases. Near misses are to be accepted.
    verdict: Verdict,
    #[serde(default)]
    invalid: Vec<Stored>,
    #[serde(default)]
    near_misses: Vec<Stored>,
}

/// A case; `code`, `kind` and `verdict` are those of its place.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Stored {
    name: String,
    /// For those who read the file.
    #[serde(default, rename = "note")]
    _note: String,
    spec_versions: Option<VersionReq>,
    base: String,
    packed: Option<Packed>,
    #[serde(default)]
    changes: Vec<Change>,
    #[serde(default)]
    hashes_kept: BTreeSet<String>,
    #[serde(default)]
    expected: Vec<Place>,
}

/// Where the rule finds something. A URDD as a whole has neither.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Place {
    file: Option<String>,
    pointer: Option<String>,
}

impl RuleCases {
    /// The cases, of the rule with this code.
    pub fn cases(self, code: &str) -> impl Iterator<Item = Case> {
        let (rule, verdict) = (self.rule, self.verdict);
        let invalid = self.invalid.into_iter().map(move |case| (case, Kind::Invalid, verdict));
        let near = self.near_misses.into_iter();
        let near = near.map(|case| (case, Kind::NearMiss, Verdict::Accept));
        invalid.chain(near).map(move |(case, kind, verdict)| {
            let near = if kind == Kind::NearMiss { "near " } else { "" };
            let expected = case.expected.into_iter();
            let finding =
                |Place { file, pointer }| Expected { code: code.to_owned(), file, pointer };
            Case {
                code: code.to_owned(),
                title: format!("{near}{rule}: {}", case.name.replace('-', " ")),
                name: case.name,
                kind,
                spec_versions: case.spec_versions.unwrap_or_else(every_version),
                verdict,
                expected: expected.map(finding).collect(),
                base: case.base,
                changes: case.changes,
                hashes_kept: case.hashes_kept,
                packed: case.packed,
            }
        })
    }
}

fn every_version() -> VersionReq {
    VersionReq::parse(SPEC_VERSIONS).unwrap_or_default()
}
