//! Cases: URDDs with one fault or a near miss, and the expected results.

use std::collections::BTreeSet;
use std::path::Path;

use semver::VersionReq;
use serde::{Deserialize, Serialize};

use crate::archive::{self, Packed};
use crate::change::Change;
use crate::data::{PACKED, URDD};
use crate::tree::{Tree, TreeError};

/// The cases of a rule, as a file of the suite has them.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RuleCases {
    /// Name of the rule.
    rule: String,
    /// The verdict on the invalid cases. Near misses are to be accepted.
    verdict: Verdict,
    #[serde(default)]
    invalid: Vec<Case>,
    #[serde(default)]
    near_misses: Vec<Case>,
}

/// A test case. What is skipped follows from its place in a file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Code of the rule under test.
    #[serde(skip)]
    pub code: String,
    /// Its name, unique within the rule.
    pub name: String,
    /// Its description.
    #[serde(skip)]
    pub title: String,
    /// Whether there is a fault.
    #[serde(skip)]
    pub kind: Kind,
    /// Words for those who read the file.
    #[serde(default)]
    pub note: String,
    /// The versions of the specification to which the verdict applies.
    #[serde(default = "every_version_one")]
    pub spec_versions: VersionReq,
    /// The expected verdict of a validator.
    #[serde(skip)]
    pub verdict: Verdict,
    /// All findings of `urdd validate`, except infos of other rules: legacy URDDs always have some.
    #[serde(default)]
    pub expected: Vec<Expected>,
    /// The base to change: a valid URDD, or a faithful one of an odd robot.
    pub base: String,
    /// The changes, in order.
    #[serde(default)]
    pub changes: Vec<Change>,
    /// Files whose size and hash in `urdd.json` are not updated after the changes.
    #[serde(default)]
    pub hashes_kept: BTreeSet<String>,
    /// Where the URDD is in a zip archive; `None` for a folder.
    pub packed: Option<Packed>,
}

/// The kind of case.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Kind {
    /// Only the rule under test finds something.
    #[default]
    Invalid,
    /// Nothing is found.
    NearMiss,
}

/// A validator's verdict on a URDD.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The URDD violates a MUST of the specification.
    Reject,
    /// The URDD satisfies every MUST; there may be warnings.
    #[default]
    Accept,
}

/// An expected finding.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// Code of the rule: in a file, that of the file.
    #[serde(skip_deserializing)]
    pub code: String,
    /// The file, relative to the URDD's root.
    pub file: Option<String>,
    /// JSON Pointer into it.
    pub pointer: Option<String>,
}

fn every_version_one() -> VersionReq {
    VersionReq::parse(">=1.0.0, <2.0.0").unwrap_or_default()
}

impl RuleCases {
    /// The cases, of the rule with this code.
    pub fn cases(self, code: &str) -> impl Iterator<Item = Case> {
        let (rule, verdict) = (self.rule, self.verdict);
        let invalid = self.invalid.into_iter().map(move |case| Case { verdict, ..case });
        let near = self.near_misses.into_iter();
        invalid.chain(near.map(|case| Case { kind: Kind::NearMiss, ..case })).map(
            move |mut case| {
                let near = if case.kind == Kind::NearMiss { "near " } else { "" };
                case.title = format!("{near}{rule}: {}", case.name.replace('-', " "));
                case.code = code.to_owned();
                case.expected.iter_mut().for_each(|finding| finding.code = code.to_owned());
                case
            },
        )
    }
}

impl Case {
    /// Its id: code, slash, name.
    pub fn id(&self) -> String {
        format!("{}/{}", self.code, self.name)
    }

    /// The name of its URDD within its folder: that of a folder, or of a zip archive.
    pub fn urdd(&self) -> &'static str {
        match self.packed {
            None => URDD,
            Some(_) => PACKED,
        }
    }

    /// Writes its URDD to a path, which becomes a folder or a zip archive.
    ///
    /// # Errors
    /// If something cannot be written, or this operating system does not support it.
    pub fn write(&self, urdd: &Tree, path: &Path) -> Result<(), TreeError> {
        match self.packed {
            None => urdd.write(path),
            Some(packed) => archive::write(urdd, packed, path),
        }
    }
}
