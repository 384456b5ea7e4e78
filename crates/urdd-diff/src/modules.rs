//! Differences of modules as a whole, where other lists do not compare them in detail, and findings of `urdd validate` that are new
//! or gone.

use std::collections::{BTreeMap, HashSet};

use serde_json::Value;
use urdd_document::module::{JsonFile, Module};
use urdd_document::urdd::Urdd;
use urdd_format::diff_report::{DiffReport, FindingDifference, ModuleDifference, Presence};
use urdd_format::index::Count;
use urdd_format::registry::ModuleKind;
use urdd_format::report::{self, Finding, Skipped};

use crate::side::Side;

/// The modules that differ; `None` unless both are URDDs. `report` has the other lists.
pub fn differences(
    before: &Side,
    after: &Side,
    report: &DiffReport,
    tolerance: f64,
) -> Option<Vec<ModuleDifference>> {
    let (a, b) = (before.urdd.as_ref()?, after.urdd.as_ref()?);
    let new = b.modules().filter(|new| module(a, &new.folder).is_none());
    let mut found = Vec::new();
    for either in a.modules().chain(new) {
        let folder = either.folder.as_str();
        let (x, y) = (module(a, folder), module(b, folder));
        let version = |module: Option<&Module>| module.and_then(|module| module.version.clone());
        let mut difference = ModuleDifference {
            name: either.name().to_owned(),
            presence: Presence::Changed,
            version_before: version(x),
            version_after: version(y),
            document: false,
            files: false,
        };
        match (x, y) {
            (Some(x), Some(y)) => {
                let same_version = difference.version_before == difference.version_after;
                let hidden = is_in_detail(either.kind, report);
                difference.document = !hidden && !same_document(x, y, tolerance);
                difference.files = !hidden && files(a, folder) != files(b, folder);
                if same_version && !difference.document && !difference.files {
                    continue;
                }
            }
            (Some(_), None) => difference.presence = Presence::Removed,
            _ => difference.presence = Presence::Added,
        }
        found.push(difference);
    }
    Some(found)
}

fn module<'a>(urdd: &'a Urdd, folder: &str) -> Option<&'a Module> {
    urdd.modules().find(|module| module.folder == folder)
}

/// Whether a difference of the module's content is in another list, or is none in meaning.
fn is_in_detail(kind: Option<ModuleKind>, report: &DiffReport) -> bool {
    match kind {
        Some(ModuleKind::Urdf | ModuleKind::OriginalMeshes) => true,
        Some(ModuleKind::Dof | ModuleKind::Bounds) => {
            !report.dofs.is_empty() || !report.joints.is_empty()
        }
        Some(ModuleKind::Loops) => !report.loops.is_empty(),
        Some(ModuleKind::LinkShapesSkips) => report.pairs.iter().flatten().next().is_some(),
        Some(ModuleKind::NamedConfigurations) => {
            report.configurations.iter().flatten().next().is_some()
        }
        _ => false,
    }
}

/// Whether two documents say the same; formatting and the order of keys aside.
fn same_document(a: &Module, b: &Module, tolerance: f64) -> bool {
    if let (Some(a), Some(b)) = (a.json.document(), b.json.document())
        && tolerance > 0.0
    {
        return is_near(&a.value, &b.value, tolerance);
    }
    match (&a.document, &b.document) {
        (Some(a), Some(b)) => a == b,
        (None, None) => match (a.json.document(), b.json.document()) {
            (Some(a), Some(b)) => a.value == b.value,
            // Unreadable ones are the business of findings, unless only one is.
            (None, None) => {
                matches!(a.json, JsonFile::Missing) == matches!(b.json, JsonFile::Missing)
            }
            _ => false,
        },
        _ => false,
    }
}

/// Whether two values differ in numbers alone, each by at most the tolerance.
fn is_near(a: &Value, b: &Value, tolerance: f64) -> bool {
    match (a, b) {
        (Value::Number(x), Value::Number(y)) => match (x.as_f64(), y.as_f64()) {
            (Some(x), Some(y)) => (x - y).abs() <= tolerance,
            _ => x == y,
        },
        (Value::Array(x), Value::Array(y)) => {
            x.len() == y.len() && x.iter().zip(y).all(|(x, y)| is_near(x, y, tolerance))
        }
        (Value::Object(x), Value::Object(y)) => {
            let mut entries = x.iter();
            x.len() == y.len()
                && entries.all(|(key, x)| y.get(key).is_some_and(|y| is_near(x, y, tolerance)))
        }
        _ => a == b,
    }
}

/// The hashes of a module's files besides its documents, as `urdd.json` has them.
fn files(urdd: &Urdd, folder: &str) -> BTreeMap<String, String> {
    let modules = urdd.metadata().into_iter().flat_map(|metadata| &metadata.modules);
    let files = modules.filter(|module| module.path == folder).flat_map(|module| &module.files);
    let files = files.filter_map(|file| {
        let name = file.path.rsplit('/').next()?;
        let is_document = ["VERSION", "module.json", "module.yaml"].contains(&name);
        (!is_document).then(|| (file.path.clone(), format!("{:?}", file.sha256)))
    });
    files.collect()
}

/// The findings that differ; `None` where they were not asked for.
pub fn findings(before: &Side, after: &Side) -> Option<Vec<FindingDifference>> {
    let (a, b) = (before.validation.as_ref()?, after.validation.as_ref()?);
    let mut found = gone(a, b, Presence::Removed);
    found.extend(gone(b, a, Presence::Added));
    Some(found)
}

/// What a finding is about, and how often it is there.
type Subjects = BTreeMap<String, u32>;

/// The findings of one that the other does not have, of rules that were meant for both.
fn gone(of: &report::Urdd, other: &report::Urdd, presence: Presence) -> Vec<FindingDifference> {
    let meant: HashSet<&str> = other
        .checks
        .iter()
        .filter(|check| check.skipped != Some(Skipped::OtherFormat))
        .map(|check| check.code.as_str())
        .collect();
    let mut there: BTreeMap<&str, Subjects> = BTreeMap::new();
    let mut cut: HashSet<&str> = HashSet::new();
    for finding in &other.findings {
        let subjects = there.entry(finding.code.as_str()).or_default();
        for subject in subjects_of(finding) {
            *subjects.entry(subject).or_default() += 1;
        }
        if finding.places_cut.0 > 0 {
            cut.insert(&finding.code);
        }
    }
    let mut found = Vec::new();
    let findings = of.findings.iter().filter(|f| meant.contains(f.code.as_str()));
    for finding in findings {
        let mut nothing = Subjects::new();
        let there = there.get_mut(finding.code.as_str()).unwrap_or(&mut nothing);
        let mut first = None;
        let mut count = 0;
        for subject in subjects_of(finding) {
            match there.get_mut(&subject) {
                Some(left) if *left > 0 => *left -= 1,
                _ => {
                    count += 1;
                    first.get_or_insert(subject);
                }
            }
        }
        // Where places are left out, only their number can be compared.
        if finding.places_cut.0 > 0 || cut.contains(finding.code.as_str()) {
            let counted = |urdd: &report::Urdd| -> u32 {
                let same = urdd.findings.iter().filter(|f| f.code == finding.code);
                same.map(|finding| finding.count.0).sum()
            };
            count = counted(of).saturating_sub(counted(other));
        }
        if count == 0 {
            continue;
        }
        found.push(FindingDifference {
            presence,
            code: finding.code.clone(),
            name: finding.name.clone(),
            severity: finding.severity,
            subject: first.filter(|subject| !subject.is_empty()),
            message: finding.message.clone(),
            count: Count(count),
        });
    }
    found
}

/// What each place of a finding is about: names where it has any, else the file and the pointer. Lines move too easily.
fn subjects_of(finding: &Finding) -> Vec<String> {
    let one = |subject: &Option<String>, file: &Option<String>, pointer: &Option<String>| {
        let place = [file, pointer].map(|part| part.clone().unwrap_or_default());
        subject.clone().unwrap_or_else(|| place.concat())
    };
    if finding.places.is_empty() {
        return vec![one(&finding.subject, &finding.file, &finding.pointer)];
    }
    let places = finding.places.iter();
    let places = places.map(|place| one(&place.subject, &place.file, &place.pointer));
    places.collect()
}
