//! Cases: URDDs with one fault or a near miss, and the expected results.

use std::collections::BTreeSet;
use std::path::Path;

use semver::VersionReq;
use serde::{Deserialize, Serialize};

use crate::archive::{self, Packed};
use crate::change::Change;
use crate::data::{PACKED, URDD};
use crate::tree::{Tree, TreeError};

/// A test case.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Code of the rule under test.
    pub code: String,
    /// Its name, unique within the rule.
    pub name: String,
    /// Its description.
    pub title: String,
    /// Whether there is a fault.
    pub kind: Kind,
    /// The versions of the specification to which the verdict applies.
    pub spec_versions: VersionReq,
    /// The expected verdict of a validator.
    pub verdict: Verdict,
    /// All findings of `urdd validate`, except infos of other rules: legacy URDDs always have some.
    pub expected: Vec<Expected>,
    /// The base to change: a valid URDD, or a faithful one of an odd robot.
    pub base: String,
    /// The changes, in order.
    pub changes: Vec<Change>,
    /// Files whose size and hash in `urdd.json` are not updated after the changes.
    pub hashes_kept: BTreeSet<String>,
    /// Where the URDD is in a zip archive; `None` for a folder.
    pub packed: Option<Packed>,
}

/// The kind of case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Only the rule under test finds something.
    Invalid,
    /// Nothing is found.
    NearMiss,
}

/// A validator's verdict on a URDD.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The URDD violates a MUST of the specification.
    Reject,
    /// The URDD satisfies every MUST; there may be warnings.
    Accept,
}

/// An expected finding.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Expected {
    /// Code of the rule.
    pub code: String,
    /// The file, relative to the URDD's root.
    pub file: Option<String>,
    /// JSON Pointer into it.
    pub pointer: Option<String>,
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
