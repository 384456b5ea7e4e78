//! Differences of modules as a whole. What other lists compare in detail is left out.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::side::Side;
use urdd_document::module::{JsonFile, Module};
use urdd_document::urdd::Urdd;
use urdd_format::diff_report::{DiffReport, ModuleDifference, Presence};
use urdd_format::registry::ModuleKind;

/// The modules that differ; `None` unless both are URDDs. `report` has the other lists.
pub(super) fn differences(
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
