//! Cases: a URDD with one fault, or with something that comes near one, and what is expected of it.

use std::collections::BTreeSet;

use semver::VersionReq;
use serde::{Deserialize, Serialize};

use super::change::Change;

/// A case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Code of the rule that it is about.
    pub code: String,
    /// Its name, unique among those of the rule.
    pub name: String,
    /// In words.
    pub title: String,
    /// Whether there is a fault.
    pub kind: Kind,
    /// The versions of the specification in which the verdict is right.
    pub spec_versions: VersionReq,
    /// What a validator should make of it.
    pub verdict: Verdict,
    /// What exactly `urdd validate` finds. Informations by other rules are not listed: legacy URDDs
    /// always have some.
    pub expected: Vec<Expected>,
    /// The valid URDD (or, for odd robots, faithful one) that is changed.
    pub base: String,
    /// What is changed, in this order.
    pub changes: Vec<Change>,
    /// Files whose size and hash in `urdd.json` do not follow the changes. All others do.
    pub hashes_kept: BTreeSet<String>,
}

/// What a case shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// The rule, and only this one, finds something.
    Invalid,
    /// Nothing is found.
    NearMiss,
}

/// What a validator makes of a URDD.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// A MUST of the specification is not kept.
    Reject,
    /// Every MUST is kept; there may be warnings.
    Accept,
}

/// A finding that is expected.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// Code of the rule.
    pub code: String,
    /// The file, relative to the URDD's root.
    pub file: Option<String>,
    /// JSON Pointer into it.
    pub pointer: Option<String>,
}

impl Case {
    /// How it is called: code, slash, name.
    pub fn id(&self) -> String {
        format!("{}/{}", self.code, self.name)
    }
}
