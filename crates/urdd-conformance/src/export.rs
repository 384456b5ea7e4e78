//! Writes the whole suite into a folder, for programs in any language, with lists of everything that a validator should
//! accept or reject, or cannot read.

use std::path::Path;

use rayon::prelude::*;
use semver::VersionReq;
use serde::Serialize;

use crate::data::{Damage, Data, LOOPED, ROBOTS, VALID, VECTORS, kept, valid_id};
use crate::profile::{Profile as ValidatorProfile, decides};
use crate::refused::{self, REFUSED};
use crate::running::{Result, RunError, Workplace};
use crate::suite::{Case, CaseKind, Expected, Suite, Verdict, every_version_one};
use crate::tree::{Tree, TreeError, remove_folder, write_file};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_format::registry::{
    FIRST_SPEC_VERSION, ModuleKind, PROGRAM_VERSION, Profile, SPEC_VERSION,
};
use urdd_generate::{Settings, generate};

const README: &str = "README.md";

/// Number of sampled configurations for the distance statistics of valid URDDs: small, so that generating takes seconds.
const NUM_SAMPLES: u32 = 20;

/// Counts of an export.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Exported {
    /// Number of valid URDDs.
    pub valid: usize,
    /// Number of cases, including near misses.
    pub cases: usize,
    /// Cases that this operating system cannot represent on disk.
    pub left_out: Vec<String>,
    /// Robots whose valid URDD differs in bytes from the one that the suite was checked with: the last digits of
    /// numbers vary between platforms.
    pub other_bytes: Vec<String>,
}

/// Writes the suite into `folder`, which is created if needed.
///
/// # Errors
/// If the folder is not empty, or cannot be written.
pub fn export(suite: &Suite, folder: &Path) -> Result<Exported> {
    let place = Workplace::new(Some(folder))?;
    let (folder, data) = (place.path(), &suite.data);
    let robots = folder.join(ROBOTS);
    data.write_robots(&robots)?;
    Tree::of(data.below(LOOPED), "").write(&folder.join(LOOPED))?;
    Tree::of(data.below(VECTORS), "").write(&folder.join(VECTORS))?;
    refused::tree(&refused::all(suite)?).write(&folder.join(REFUSED))?;
    let never = Cancellation::default();
    let (names, valid) = (data.robots(), folder.join(VALID));
    let other_bytes = write_valid(data, &names, &robots, &valid, &never)?;
    let left_out = write_cases(suite, folder)?;

    let mut items = items(suite)?;
    items.retain(|item| !left_out.contains(&item.id));
    let valid = items.iter().filter(|item| item.kind == CaseKind::Valid).count();
    let cases = items.len() - valid;
    let exported = Exported { valid, cases, left_out: left_out.clone(), other_bytes };
    for (name, text) in catalogues(&items, &left_out) {
        let path = folder.join(name);
        let text = text.map_err(|error| TreeError::Write(path.clone(), error.into()))?;
        write_file(&path, (text + "\n").as_bytes())?;
    }
    if let Some(readme) = data.file(README) {
        write_file(&folder.join(README), readme)?;
    }
    Ok(exported)
}

/// Generates the valid URDDs of these robots, whose URDFs are in the folder `robots`. Returns the robots whose bytes
/// differ from those that the suite was checked with.
pub fn write_valid(
    data: &Data,
    names: &[String],
    robots: &Path,
    folder: &Path,
    cancellation: &Cancellation,
) -> Result<Vec<String>> {
    let mut settings = Settings { num_samples: NUM_SAMPLES, ..Settings::default() };
    settings.source.cancellation = cancellation.clone();
    let mut other_bytes = Vec::new();
    for robot in names {
        let target = folder.join(robot);
        generate(&robots.join(format!("{robot}.urdf")), &target, &settings, &())
            .map_err(|error| RunError::Generate(robot.clone(), Box::new(error)))?;
        let made = Tree::read(&target, &target)?;
        if kept(&made) != data.carried(robot) {
            other_bytes.push(robot.clone());
        }
    }
    Ok(other_bytes)
}

/// Writes every case. Returns those that this operating system cannot represent.
fn write_cases(suite: &Suite, folder: &Path) -> Result<Vec<String>> {
    let write = |case: &Case| -> Result<Option<String>> {
        let case_folder = folder.join(case.folder());
        match case.write(&suite.tree(case)?, &case_folder.join(case.urdd())) {
            Ok(()) => Ok(None),
            Err(TreeError::Unsupported(_)) => {
                remove_folder(&case_folder)?;
                Ok(Some(case.id()))
            }
            Err(error) => Err(error.into()),
        }
    };
    let cases: Vec<&Case> = suite.all_cases().collect();
    cases.par_iter().filter_map(|case| write(case).transpose()).collect()
}

/// The catalogue of an exported suite, of all that is accepted or rejected.
pub const CATALOGUE: &str = "suite.json";
/// The catalogue in its newer version, with what cannot be read, and profiles.
pub const CATALOGUE_1_1: &str = "suite-1.1.json";

#[derive(Debug, Serialize)]
struct Catalogue<'a, T> {
    /// The version of the catalogue's form; the first has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    version: Option<&'static str>,
    /// The version of the specification that the suite was written for.
    spec_version: &'static str,
    /// The version of the program that exported it.
    urdd: &'static str,
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
    /// Whether a validator may leave it unverified (SPEC 8.8.9, 8.9.7).
    #[serde(skip)]
    pub may_be_unverified: bool,
}

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
    let valid = suite.data.robots().into_iter().map(|robot| {
        let id = valid_id(&robot);
        Ok(Item {
            folder: id.clone(),
            id,
            kind: CaseKind::Valid,
            code: None,
            title: format!("what urdd generate makes of {robot}.urdf"),
            profile: Profile::V1.as_str(),
            spec_versions: versions(suite.data.carried(&robot).file(ROOT_METADATA))
                .unwrap_or_else(every_version_one),
            verdict: Verdict::Accept,
            findings: Vec::new(),
            is_about_reading: false,
            profiles: ValidatorProfile::ALL.to_vec(),
            may_be_unverified: has_unverified(&suite.data.carried(&robot)),
        })
    });
    valid.chain(suite.all_cases().map(|case| item(suite, case))).collect()
}

fn item(suite: &Suite, case: &Case) -> Result<Item, Damage> {
    let is_v1 = |base: &Tree| base.file(ROOT_METADATA).is_some();
    let edition = match suite.bases.get(&case.base).is_some_and(is_v1) {
        true => Profile::V1,
        false => Profile::Legacy,
    };
    let mut profiles = Vec::new();
    for profile in ValidatorProfile::ALL {
        if edition == Profile::V1 && decides(profile, suite, case)? {
            profiles.push(profile);
        }
    }
    let may_be_unverified = match case.verdict {
        Verdict::Accept => suite.bases.get(&case.base).is_some_and(has_unverified),
        Verdict::Reject => UNVERIFIED.contains(&case.code.as_str()),
        Verdict::Unreadable => false,
    };
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
        profiles,
        may_be_unverified,
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
fn catalogues(
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

/// Rules that a validator may leave unverified (SPEC 8.8.9, 8.9.7). Without LRN010 it does not know the rates of LRN011.
const UNVERIFIED: [&str; 7] =
    ["LRN010", "LRN011", "SPH005", "SPH006", "SPH007", "SPH008", "SPH012"];

/// Whether a URDD has what a validator may leave unverified.
fn has_unverified(urdd: &Tree) -> bool {
    let modules = [ModuleKind::SelfCollisionModel, ModuleKind::LinkShapesSpheres];
    modules.iter().any(|kind| urdd.file(&format!("{}/module.json", kind.folder())).is_some())
}
