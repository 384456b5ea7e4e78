//! Validates a URDF without a URDD, with the rules that need only the source: whether it describes one tree, whether
//! its names resolve, and what is unusual about it.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::context::Context;
use super::engine::{Outcomes, run_all};
use super::reference::urdf_text;
use super::rule::{Need, Rule};
use super::rules;
use super::two_robots::Judges;
use urdd_directory::discover::Found;
use urdd_directory::file_type::FileType;
use urdd_directory::root::{ReadError, Root};
use urdd_directory::source::Memory;
use urdd_document::carried_urdf::{self, CarriedUrdf};
use urdd_document::load::Loaded;
use urdd_document::module::{JsonFile, MetadataFile};
use urdd_document::urdd::Urdd;
use urdd_findings::check::{Check, Outcome};
use urdd_findings::code::Code;
use urdd_findings::examined::Examined;
use urdd_findings::skip::SkipReason;
use urdd_format::registry::Profile;
use urdd_format::report::Kind;
use urdd_xml::Xml;

/// Whether a path is a file with the extension of a URDF.
pub fn is_urdf(path: &Path) -> bool {
    FileType::Urdf.is_of(path) && path.is_file()
}

/// The URDF at a path: its folder, and its file name.
pub(super) fn found(path: &Path) -> Found {
    // The target of a symbolic link can be in another folder.
    let target = path.is_symlink().then(|| path.canonicalize().unwrap_or_default());
    let path = target.as_deref().unwrap_or(path);
    let name = path.file_name().unwrap_or_default();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    Found { path: folder.to_owned(), name: name.to_string_lossy().into_owned(), closed: None }
}

/// Examines a URDF with the rules that apply to it.
pub(super) fn examine(found: &Found, rules: &[&'static Rule]) -> Result<Examined, ReadError> {
    let root = Root::open(&found.path)?;
    let urdf = carried_urdf::read_file(&root, &found.name)?;
    Ok(judged(Context::new(alone(root, urdf), None), &found.name, rules))
}

/// Examines the text of a URDF with the rules that need nothing else. `name` is its name in the report.
pub fn examine_urdf(xml: &Xml<'_>, name: &str) -> Examined {
    Examined::caught::<ReadError>(Kind::Urdf, name, || {
        let urdf = CarriedUrdf::of_bytes(name, xml.text().as_bytes())?;
        // A byte order mark is not part of the URDF.
        let reading = (urdf.text == xml.text()).then(|| urdf_text::of(xml));
        let no_files = Memory::new(name, BTreeMap::new()).map_err(|_| ReadError::Missing)?;
        let context = Context::new(alone(Root::of(no_files), urdf), None);
        Ok(judged(context.with_urdf_text(reading), name, &rules::all()))
    })
}

fn judged(context: Context, name: &str, rules: &[&'static Rule]) -> Examined {
    let rules = rules.iter().copied().filter(|rule| is_for_urdf(rule));
    let mut outcomes = Outcomes::new();
    let by_urdf = context.by_urdf();
    let judged = by_urdf.as_ref().unwrap_or(&context);
    let mut checks: Vec<Check> = run_all(judged, rules.collect(), &mut outcomes);
    if by_urdf.is_none() {
        say_that_it_is_unreadable(&mut checks);
    }
    checks.sort_by_key(|check| check.rule.code);
    judged.examined(Kind::Urdf, name, checks)
}

/// Where URD011 found a fault, there is no robot for that reason, not because a module is not here.
fn say_that_it_is_unreadable(checks: &mut [Check]) {
    let is_fault =
        |check: &Check| check.rule.code == Code::URD011 && check.outcome == Outcome::Failed;
    if !checks.iter().any(is_fault) {
        return;
    }
    for check in checks {
        if let Outcome::Skipped(SkipReason::Absent(_)) = check.outcome {
            check.outcome = Outcome::Skipped(SkipReason::Failed(Code::URD011));
        }
    }
}

fn is_for_urdf(rule: &Rule) -> bool {
    use Need::{AnyModule, Legacy, Module, ModuleV1, RootMetadata};
    let module = |need: &Need| {
        matches!(need, Module(_) | ModuleV1(_) | AnyModule(_) | RootMetadata | Legacy)
    };
    match Judges::of(rule) {
        Judges::Robot | Judges::Source => true,
        Judges::AsItStands | Judges::Derived => {
            let urdf = |need: &Need| matches!(need, Need::CarriedUrdf | Need::UrdfFile);
            rule.needs.iter().any(urdf) && !rule.needs.iter().any(module)
        }
    }
}

/// A URDD with a URDF and no modules.
fn alone(root: Root, urdf: CarriedUrdf) -> Urdd {
    Urdd::new(Arc::new(Loaded {
        root,
        listing: Arc::default(),
        metadata: Arc::new(MetadataFile {
            json: JsonFile::Missing,
            metadata: None,
            violations: Vec::new(),
        }),
        modules: Vec::new(),
        urdf: Ok(urdf),
        profile: Profile::V1,
    }))
}
