//! Writes the whole suite into a folder, for programs in any language, with lists of everything that a validator should
//! accept or reject, or cannot read.

use std::path::Path;

use rayon::prelude::*;
use semver::VersionReq;
use serde::Serialize;
use serde_json::Value;

use crate::data::{Damage, Data, ROBOTS, VALID, VECTORS, kept, valid_id};
use crate::refused::{self, REFUSED};
use crate::running::{Result, RunError, Workplace};
use crate::suite::{Case, CaseKind, Expected, Suite, Verdict, every_version_one};
use crate::tree::{Tree, TreeError, remove_folder, write_file};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_document::module::is_extension;
use urdd_format::conformance::ValidatorProfile;
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
            profiles: vec![ValidatorProfile::CoreJson],
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
    let is_core_json = edition == Profile::V1 && is_core_json(suite, case)?;
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

/// The profile `core-json` (SPEC 12.3): families of the rules about `urdd.json`, `VERSION`, `module.json` of Core modules and the source.
const FAMILIES: [&str; 13] =
    ["DIR", "JSN", "SCH", "URD", "SRC", "DOF", "CHN", "CON", "BND", "CMP", "CNF", "LOP", "KIN"];
/// Rules of these families about what the profile passes over: mirrors that are missing, and drafts.
const OTHERS: [&str; 2] = ["DIR010", "DIR030"];
/// Rules about what documents name: the profile reads the documents of Core modules alone.
const NOT_LISTED: &str = "DIR012";
const NOT_A_FILE: &str = "DIR023";

/// Whether a validator of the profile can decide a case of version 1.
///
/// # Errors
/// If the case is damaged.
fn is_core_json(suite: &Suite, case: &Case) -> Result<bool, Damage> {
    let is_of_rule = FAMILIES.iter().any(|family| case.code.starts_with(family))
        && !OTHERS.contains(&case.code.as_str());
    if case.packed.is_some() || !(is_of_rule || case.is_about_reading()) {
        return Ok(false);
    }
    if case.kind != CaseKind::Invalid || case.verdict != Verdict::Reject {
        return Ok(true);
    }
    let files = case.expected.iter().filter_map(|expected| expected.file.as_deref());
    if files.into_iter().any(is_passed_over) {
        return Ok(false);
    }
    Ok(match &*case.code {
        NOT_LISTED => case.expected.iter().all(is_of_core(suite, case)?),
        NOT_A_FILE => case.expected.iter().all(is_listed(suite, case)?),
        _ => true,
    })
}

/// Whether a file is of no interest to the profile: a mirror, or of an extension or a module that is not at the root.
fn is_passed_over(path: &str) -> bool {
    let (first, last) = (path.split('/').next(), path.rsplit('/').next());
    let is_above =
        |kind: &ModuleKind| kind.folder().split_once('/').map(|(above, _)| above) == first;
    matches!(last, Some("module.yaml" | "schema.json"))
        || first.is_some_and(is_extension)
        || ModuleKind::ALL.iter().any(is_above)
}

/// Whether a finding is about `urdd.json`, or a file that it lists or names.
fn is_listed(suite: &Suite, case: &Case) -> Result<impl Fn(&Expected) -> bool, Damage> {
    let tree = suite.tree(case)?;
    let metadata = tree.file(ROOT_METADATA).map(String::from_utf8_lossy).unwrap_or_default();
    let metadata = metadata.into_owned();
    Ok(move |expected: &Expected| {
        let file = expected.file.as_deref().unwrap_or(ROOT_METADATA);
        file == ROOT_METADATA || metadata.contains(&format!("{file:?}"))
    })
}

/// Whether a finding in `urdd.json` is about a Core module: one whose folder is in the root.
fn is_of_core(suite: &Suite, case: &Case) -> Result<impl Fn(&Expected) -> bool, Damage> {
    let tree = suite.tree(case)?;
    let metadata = tree.file(ROOT_METADATA).and_then(|bytes| json::read(bytes).ok());
    let metadata = metadata.map_or(Value::Null, |document| document.value);
    Ok(move |expected: &Expected| {
        let at = expected.pointer.as_deref().unwrap_or_default().split('/').nth(2);
        let name = at.and_then(|at| metadata.pointer(&format!("/modules/{at}/name")));
        let is_named = |kind: &ModuleKind| name.and_then(Value::as_str) == Some(kind.folder());
        ModuleKind::ALL.iter().any(is_named)
    })
}
