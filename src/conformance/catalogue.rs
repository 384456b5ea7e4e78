//! Everything that a validator should accept or reject, as a list.

use semver::VersionReq;
use serde::Serialize;

use super::case::{Expected, Kind, Verdict};
use super::data::{INVALID, URDD};
use super::suite::Suite;
use super::valid;
use urdd_directory::discover::ROOT_METADATA;
use urdd_format::registry::{Profile, SPEC_VERSION};

/// The file of an exported suite that lists everything.
pub const CATALOGUE: &str = "suite.json";

/// What an exported suite holds, as [`CATALOGUE`] says it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Catalogue {
    /// The version of the specification that the suite was written for.
    pub spec_version: String,
    /// The version of the program that exported it.
    pub urdd: String,
    /// Every URDD.
    pub cases: Vec<Item>,
    /// Cases that this operating system cannot have on disk.
    pub left_out: Vec<String>,
}

/// A URDD, and what a validator should make of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Item {
    /// Its name: `valid/gripper`, or the code, a slash and a name.
    pub id: String,
    /// Its folder, from where the list is.
    pub folder: String,
    /// Which part of the suite it is of.
    pub kind: ItemKind,
    /// Code of the rule that it is about; null for valid URDDs.
    pub code: Option<String>,
    /// In words.
    pub title: String,
    /// `1.0`, or `legacy`: of a module version from before there was a specification.
    pub profile: &'static str,
    /// The versions of the specification in which the verdict is right.
    pub spec_versions: VersionReq,
    /// What a validator should make of it.
    pub verdict: Verdict,
    /// What exactly `urdd validate` finds, besides informations by other rules.
    pub findings: Vec<Expected>,
}

/// Which part of the suite a URDD is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ItemKind {
    /// Made by `urdd generate`.
    Valid,
    /// With a fault.
    Invalid,
    /// With something that comes near a fault.
    NearMiss,
}

/// Every URDD of the suite: the valid ones, then the cases.
pub fn items(suite: &Suite) -> Vec<Item> {
    let valid = valid::robots().into_iter().map(|robot| {
        let id = valid::id(&robot);
        Item {
            folder: id.clone(),
            id,
            kind: ItemKind::Valid,
            code: None,
            title: format!("what urdd generate makes of {robot}.urdf"),
            profile: Profile::V1.as_str(),
            spec_versions: every_version_one(),
            verdict: Verdict::Accept,
            findings: Vec::new(),
        }
    });
    let cases = suite.cases.iter().map(|case| {
        let is_v1 = |base: &super::tree::Tree| base.file(ROOT_METADATA).is_some();
        let profile = match suite.bases.get(&case.base).is_some_and(is_v1) {
            true => Profile::V1,
            false => Profile::Legacy,
        };
        Item {
            id: case.id(),
            folder: format!("{INVALID}/{}/{URDD}", case.id()),
            kind: match case.kind {
                Kind::Invalid => ItemKind::Invalid,
                Kind::NearMiss => ItemKind::NearMiss,
            },
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

/// From the version that the suite was written for to the next major one.
fn every_version_one() -> VersionReq {
    VersionReq::parse(&format!("^{SPEC_VERSION}")).unwrap_or_default()
}
