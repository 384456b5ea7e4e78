//! Profiles of validators (SPEC 12.2, 12.3): which cases one of them can decide.

use serde::Serialize;
use serde_json::Value;

use crate::data::Damage;
use crate::suite::{Case, CaseKind, Expected, Suite, Verdict};
use crate::tree::{FilePath, Node, Tree};
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::json;
use urdd_document::module::is_extension;
use urdd_format::registry::ModuleKind;
use urdd_format::root_metadata::ConformanceClass;

/// What a validator judges that passes over the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// Core modules, by their JSON and the source alone: SPEC 12.3.
    CoreJson,
    /// The class Core, as SPEC 12.2 has it.
    Core,
    /// The class Geometry.
    Geometry,
    /// The class Shapes.
    Shapes,
}

impl Profile {
    /// All of them.
    pub const ALL: [Profile; 4] =
        [Profile::CoreJson, Profile::Core, Profile::Geometry, Profile::Shapes];

    /// The class; `None` for `core-json`.
    pub fn class(self) -> Option<ConformanceClass> {
        match self {
            Profile::CoreJson => None,
            Profile::Core => Some(ConformanceClass::Core),
            Profile::Geometry => Some(ConformanceClass::Geometry),
            Profile::Shapes => Some(ConformanceClass::Shapes),
        }
    }
}

/// Families of the rules about `urdd.json`, `VERSION`, `module.json` of Core modules and the source: of each profile.
const FAMILIES: [&str; 13] =
    ["DIR", "JSN", "SCH", "URD", "SRC", "DOF", "CHN", "CON", "BND", "CMP", "CNF", "LOP", "KIN"];

/// The families that a profile has besides.
fn more_families(profile: Profile) -> &'static [&'static str] {
    match profile {
        Profile::CoreJson => &[],
        Profile::Core => &["YML", "EXT"],
        Profile::Geometry => &["YML", "EXT", "MSH"],
        Profile::Shapes => &["YML", "EXT", "MSH", "SHP"],
    }
}

/// Words of SPEC 11.4 that count what is in modules that a profile passes over.
fn uncounted(profile: Profile) -> &'static [&'static str] {
    match profile {
        Profile::CoreJson | Profile::Core => &["piece", "_shape", "pair"],
        Profile::Geometry | Profile::Shapes => &["pair"],
    }
}

/// Rules of [`FAMILIES`] about what `core-json` passes over: mirrors that are missing, and drafts.
const NOT_OF_JSON: [&str; 2] = ["DIR010", "DIR030"];
/// Rule about what documents name: a profile reads the documents of its modules alone.
const NOT_LISTED: &str = "DIR012";
/// Rules about the numbers of SPEC 11.4.
const COUNTED: [&str; 2] = ["EXT003", "EXT004"];

/// Whether a validator of a profile reads the documents of a module.
fn reads(profile: Profile, kind: ModuleKind) -> bool {
    let is_of = |other: ModuleKind| above(other.folder()) == above(kind.folder());
    let is_core = above(kind.folder()).is_none();
    match profile {
        Profile::CoreJson | Profile::Core => is_core,
        Profile::Geometry => is_core || is_of(ModuleKind::PlainMeshes),
        Profile::Shapes => kind.class().is_some() || is_core,
    }
}

/// The folder in the root that a module's folder is in; `None` if that one is in the root.
fn above(folder: &str) -> Option<&str> {
    folder.split_once('/').map(|(above, _)| above)
}

/// Whether a validator of a profile can decide a case of version 1.
///
/// # Errors
/// If the case is damaged.
pub(crate) fn decides(profile: Profile, suite: &Suite, case: &Case) -> Result<bool, Damage> {
    let families = FAMILIES.iter().chain(more_families(profile));
    let is_json = profile == Profile::CoreJson;
    let is_of_rule = families.into_iter().any(|family| case.code.starts_with(family))
        && !(is_json && NOT_OF_JSON.contains(&case.code.as_str()));
    if (is_json && case.packed.is_some()) || !(is_of_rule || case.is_about_reading()) {
        return Ok(false);
    }
    if case.kind != CaseKind::Invalid || case.verdict != Verdict::Reject {
        return Ok(true);
    }
    let files = case.expected.iter().filter_map(|expected| expected.file.as_deref());
    if files.into_iter().any(|file| is_passed_over(profile, file)) {
        return Ok(false);
    }
    Ok(match case.code.as_str() {
        code if COUNTED.contains(&code) => !counts_others(profile, &suite.tree(case)?),
        NOT_LISTED => case.expected.iter().all(is_of_profile(profile, &suite.tree(case)?)),
        _ => true,
    })
}

/// Whether a file is of no interest to a profile: of a module that it passes over, and for `core-json` a mirror, or of an
/// extension.
fn is_passed_over(profile: Profile, path: &str) -> bool {
    let (first, last) = (path.split('/').next(), path.rsplit('/').next());
    let is_below = |kind: &ModuleKind| {
        let mut beside = ModuleKind::ALL.iter().filter(|other| above(other.folder()) == first);
        let folder = match beside.any(|other| reads(profile, *other)) {
            true => kind.folder(),
            false => above(kind.folder()).unwrap_or(kind.folder()),
        };
        FilePath::from(path).is_within(&folder.into())
    };
    let mut unread = ModuleKind::ALL.iter().filter(|kind| !reads(profile, **kind));
    let is_json = profile == Profile::CoreJson;
    let is_other =
        matches!(last, Some("module.yaml" | "schema.json")) || first.is_some_and(is_extension);
    (is_json && is_other) || unread.any(is_below)
}

/// Whether the schema of an extension has a word that counts what a profile passes over.
fn counts_others(profile: Profile, urdd: &Tree) -> bool {
    let is_schema = |path: &FilePath| path.as_bytes().ends_with(b"/schema.json");
    let schemas = urdd.nodes.iter().filter(|(path, _)| is_schema(path));
    let mut texts = schemas.filter_map(|(_, node)| match node {
        Node::File(bytes) => Some(String::from_utf8_lossy(bytes)),
        Node::Link(_) | Node::Folder => None,
    });
    texts.any(|text| uncounted(profile).iter().any(|word| text.contains(word)))
}

/// Whether a finding in `urdd.json` is about a module whose documents a profile reads.
fn is_of_profile(profile: Profile, urdd: &Tree) -> impl Fn(&Expected) -> bool {
    let metadata = urdd.file(ROOT_METADATA).and_then(|bytes| json::read(bytes).ok());
    let metadata = metadata.map_or(Value::Null, |document| document.value);
    move |expected: &Expected| {
        let at = expected.pointer.as_deref().unwrap_or_default().split('/').nth(2);
        let name = at.and_then(|at| metadata.pointer(&format!("/modules/{at}/name")));
        let name = name.and_then(Value::as_str).unwrap_or_default();
        let is_named = |kind: &&ModuleKind| name == kind.name();
        match ModuleKind::ALL.iter().find(is_named) {
            Some(kind) => reads(profile, *kind),
            None => profile != Profile::CoreJson && is_extension(name),
        }
    }
}
