//! A list of everything that a validator should accept or reject.

use semver::VersionReq;
use serde::Serialize;

use crate::case::{Expected, Kind, Verdict};
use crate::data::INVALID;
use crate::suite::Suite;
use crate::valid;
use urdd_directory::discover::ROOT_METADATA;
use urdd_format::registry::{Profile, SPEC_VERSION};

/// The catalogue file of an exported suite.
pub const CATALOGUE: &str = "suite.json";

/// The content of an exported suite, in [`CATALOGUE`].
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Catalogue {
    /// The version of the specification that the suite was written for.
    pub spec_version: String,
    /// The version of the program that exported it.
    pub urdd: String,
    /// Every URDD.
    pub cases: Vec<Item>,
    /// Cases that this operating system cannot represent on disk.
    pub left_out: Vec<String>,
}

/// A URDD, and its expected verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Item {
    /// Its name: `valid/gripper`, or the code, a slash and a name.
    pub id: String,
    /// Its folder, or its zip archive, relative to the catalogue.
    pub folder: String,
    /// Its part of the suite.
    pub kind: Kind,
    /// Code of the rule under test; null for valid URDDs.
    pub code: Option<String>,
    /// Its description.
    pub title: String,
    /// `1.0`, or `legacy` for a module version from before the specification.
    pub profile: &'static str,
    /// The versions of the specification to which the verdict applies.
    pub spec_versions: VersionReq,
    /// The expected verdict of a validator.
    pub verdict: Verdict,
    /// All findings of `urdd validate`, except infos of other rules.
    pub findings: Vec<Expected>,
}

/// Every URDD of the suite: the valid ones, then the cases.
pub fn items(suite: &Suite) -> Vec<Item> {
    let valid = valid::robots(&suite.data).into_iter().map(|robot| {
        let id = valid::id(&robot);
        Item {
            folder: id.clone(),
            id,
            kind: Kind::Valid,
            code: None,
            title: format!("what urdd generate makes of {robot}.urdf"),
            profile: Profile::V1.as_str(),
            spec_versions: every_version_one(),
            verdict: Verdict::Accept,
            findings: Vec::new(),
        }
    });
    let cases = suite.cases.iter().map(|case| {
        let is_v1 = |base: &crate::tree::Tree| base.file(ROOT_METADATA).is_some();
        let profile = match suite.bases.get(&case.base).is_some_and(is_v1) {
            true => Profile::V1,
            false => Profile::Legacy,
        };
        Item {
            id: case.id(),
            folder: format!("{INVALID}/{}/{}", case.id(), case.urdd()),
            kind: case.kind,
            code: Some(case.code.clone()),
            title: case.title.clone(),
            profile: profile.as_str(),
            spec_versions: case.spec_versions.clone(),
            verdict: case.verdict,
            findings: case.expected.clone(),
        }
    });
    valid.chain(cases).collect()
}

/// All versions with the major number of the suite's version, from that version on.
fn every_version_one() -> VersionReq {
    VersionReq::parse(&format!("^{SPEC_VERSION}")).unwrap_or_default()
}
