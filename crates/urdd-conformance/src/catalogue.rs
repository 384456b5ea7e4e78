//! A list of everything that a validator should accept or reject, or cannot read.

use semver::VersionReq;
use serde::Serialize;

use crate::case::{Case, CaseKind, Expected, Verdict, every_version_one};
use crate::data::Damage;
use crate::profile;
use crate::suite::Suite;
use crate::valid::{self, carried};
use urdd_directory::discover::ROOT_METADATA;
use urdd_format::conformance::ValidatorProfile;
use urdd_format::registry::{FIRST_SPEC_VERSION, PROGRAM_VERSION, Profile, SPEC_VERSION};

/// The catalogue of an exported suite, of all that is accepted or rejected.
pub const CATALOGUE: &str = "suite.json";
/// The catalogue in its newer version, with what cannot be read, and profiles.
pub const CATALOGUE_1_1: &str = "suite-1.1.json";

/// The content of a catalogue.
#[derive(Debug, Serialize)]
struct Catalogue<'a, T> {
    /// The version of the catalogue's form; the first has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<&'static str>,
    /// The version of the specification that the suite was written for.
    spec_version: &'static str,
    /// The version of the program that exported it.
    urdd: &'static str,
    /// Every URDD.
    cases: Vec<T>,
    /// Cases that this operating system cannot represent on disk.
    left_out: Vec<&'a String>,
}

/// A URDD, and its expected verdict.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Item {
    /// Its name: `valid/gripper`, or the code, a slash and a name.
    pub id: String,
    /// Its folder, or its zip archive, relative to the catalogue.
    pub folder: String,
    /// Its part of the suite.
    pub kind: CaseKind,
    /// Code of the rule under test; null for valid URDDs, and where no rule is about it.
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
    /// Whether it is about what cannot be read.
    #[serde(skip)]
    pub is_about_reading: bool,
    /// The profiles whose validators can decide it.
    #[serde(skip)]
    pub profiles: Vec<ValidatorProfile>,
}

/// An item of [`CATALOGUE_1_1`].
#[derive(Debug, Serialize)]
struct NewerItem<'a> {
    #[serde(flatten)]
    item: &'a Item,
    profiles: &'a [ValidatorProfile],
}

/// Every URDD of the suite: the valid ones, then the cases.
///
/// # Errors
/// If a case is damaged.
pub fn items(suite: &Suite) -> Result<Vec<Item>, Damage> {
    let valid = valid::robots(&suite.data).into_iter().map(|robot| {
        let id = valid::id(&robot);
        Ok(Item {
            folder: id.clone(),
            id,
            kind: CaseKind::Valid,
            code: None,
            title: format!("what urdd generate makes of {robot}.urdf"),
            profile: Profile::V1.as_str(),
            spec_versions: versions(carried(&suite.data, &robot).file(ROOT_METADATA))
                .unwrap_or_else(every_version_one),
            verdict: Verdict::Accept,
            findings: Vec::new(),
            is_about_reading: false,
            profiles: vec![ValidatorProfile::CoreJson],
        })
    });
    valid.chain(suite.all_cases().map(|case| item(suite, case))).collect()
}

fn item(suite: &Suite, case: &Case) -> Result<Item, Damage> {
    let is_v1 = |base: &crate::tree::Tree| base.file(ROOT_METADATA).is_some();
    let edition = match suite.bases.get(&case.base).is_some_and(is_v1) {
        true => Profile::V1,
        false => Profile::Legacy,
    };
    let is_core_json = edition == Profile::V1 && profile::is_core_json(suite, case)?;
    Ok(Item {
        id: case.id(),
        folder: format!("{}/{}", case.folder(), case.urdd()),
        kind: case.kind,
        code: (!case.is_about_reading()).then(|| case.code.clone()),
        title: case.title.clone(),
        profile: edition.as_str(),
        spec_versions: suite
            .bases
            .get(&case.base)
            .and_then(|base| versions(base.file(ROOT_METADATA)))
            .unwrap_or_else(|| case.spec_versions.clone()),
        verdict: case.verdict,
        findings: case.expected.clone(),
        is_about_reading: case.is_about_reading(),
        profiles: is_core_json.then_some(ValidatorProfile::CoreJson).into_iter().collect(),
    })
}

/// The versions of the specification that know all modules of a URDD, by what its metadata states; `None` for all of
/// version 1. To an older one, a module that was added later is unknown, and its faults are none.
fn versions(metadata: Option<&[u8]>) -> Option<VersionReq> {
    let metadata: serde_json::Value = serde_json::from_slice(metadata?).ok()?;
    let stated =
        metadata["urdd_version"].as_str().filter(|stated| *stated != FIRST_SPEC_VERSION)?;
    VersionReq::parse(&format!(">={stated}, <2.0.0")).ok()
}

/// The catalogues, by their names. The first stays as readers of it know it.
pub(crate) fn files(
    items: &[Item],
    left_out: &[String],
) -> [(&'static str, serde_json::Result<String>); 2] {
    let is_newer = |id: &str| items.iter().any(|item| item.is_about_reading && item.id == id);
    let older = items.iter().filter(|item| !item.is_about_reading);
    let newer = items.iter().map(|item| NewerItem { item, profiles: &item.profiles });
    [
        (
            CATALOGUE,
            text(None, older.collect(), left_out.iter().filter(|id| !is_newer(id)).collect()),
        ),
        (CATALOGUE_1_1, text(Some("1.1"), newer.collect(), left_out.iter().collect())),
    ]
}

fn text<T: Serialize>(
    version: Option<&'static str>,
    cases: Vec<T>,
    left_out: Vec<&String>,
) -> serde_json::Result<String> {
    serde_json::to_string_pretty(&Catalogue {
        version,
        spec_version: SPEC_VERSION,
        urdd: PROGRAM_VERSION,
        cases,
        left_out,
    })
}
