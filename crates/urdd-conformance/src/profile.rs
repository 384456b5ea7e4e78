//! Which cases a validator of the profile `core-json` can decide (SPEC 12.3).

use serde_json::Value;

use crate::case::{Case, CaseKind, Expected, Verdict};
use crate::data::Damage;
use crate::suite::Suite;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_document::module::is_extension;
use urdd_format::registry::ModuleKind;

/// Families of the rules about `urdd.json`, `VERSION`, `module.json` of Core modules and the source.
const FAMILIES: [&str; 13] =
    ["DIR", "JSN", "SCH", "URD", "SRC", "DOF", "CHN", "CON", "BND", "CMP", "CNF", "LOP", "KIN"];
/// Rules of these families about what the profile passes over: mirrors that are missing, and drafts.
const OTHERS: [&str; 2] = ["DIR010", "DIR030"];
/// Rule about what documents name: the profile reads the documents of Core modules alone.
const NOT_LISTED: &str = "DIR012";

/// Whether a validator of the profile can decide a case of version 1.
///
/// # Errors
/// If the case is damaged.
pub fn is_core_json(suite: &Suite, case: &Case) -> Result<bool, Damage> {
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
    Ok(case.code != NOT_LISTED || case.expected.iter().all(is_of_core(suite, case)?))
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
