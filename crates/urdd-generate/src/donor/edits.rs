//! The user's edits of the skip matrix (MoveIt's allowed collision matrix), which a new URDD takes over.
//!
//! They are read before any module is built. If they cannot be read, generation fails: a syntax error must not discard
//! a user's work.

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value;

use super::Donor;
use crate::error::{EditsFault, GenerateError};
use crate::selection::Selection;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::{self, Position};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::text_fault::{KEPT_PER_KIND, TextFaultKind};
use urdd_directory::yaml;
use urdd_format::chain::ChainModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::registry::ModuleKind;

/// Key of the edits.
const EDITS: &str = "edits";
/// Key of the reasons for which pairs are skipped.
const SKIPPED_REASONS: &str = "skipped_reasons";

/// The user's decisions about the skips of a URDD.
#[derive(Debug, Clone)]
pub(crate) struct Decisions {
    /// The reasons for which pairs are skipped.
    pub skipped_reasons: Vec<SkippedReason>,
    /// The edits.
    pub edits: Vec<SkipEdit>,
}

impl Default for Decisions {
    /// The defaults: no edits, and the usual reasons.
    fn default() -> Self {
        Decisions {
            skipped_reasons: SkippedReason::USUAL.to_vec(),
            edits: Vec::new(),
        }
    }
}

/// The user's decisions about the skips, checked against the links of a robot.
#[derive(Debug, Clone, Default)]
pub(crate) struct Edits {
    /// The reasons for which pairs are skipped.
    pub skipped_reasons: Vec<SkippedReason>,
    /// Edits whose links the robot has.
    pub kept: Vec<SkipEdit>,
    /// The other edits.
    pub lost: Vec<SkipEdit>,
}

impl Edits {
    /// Splits the edits by the links of this robot.
    pub fn of(decisions: Decisions, chain: &ChainModule) -> Self {
        let is_link = |name: &str| {
            let mut links = chain.links_in_chain.iter();
            links.any(|link| link.name == name)
        };
        let (kept, lost) = decisions
            .edits
            .into_iter()
            .partition(|edit| is_link(&edit.link_a) && is_link(&edit.link_b));
        Edits {
            skipped_reasons: decisions.skipped_reasons,
            kept,
            lost,
        }
    }
}

/// Reads the edits from a folder that is to be replaced, whatever else is wrong with it.
///
/// # Errors
/// If there may be edits and they cannot be read, or if the selected modules would not hold them.
pub(crate) fn read(
    folder: &Path,
    selection: &Selection,
    replaced: Option<&Donor>,
) -> Result<Decisions, GenerateError> {
    let Ok(root) = Root::open(folder) else {
        return Ok(Decisions::default());
    };
    let kind = ModuleKind::LinkShapesSkips;
    let json_path = format!("{}/module.json", kind.folder());
    let yaml_path = format!("{}/module.yaml", kind.folder());
    let refused = |path: &str, at: Option<Position>, fault: EditsFault| GenerateError::Edits {
        file: folder.join(path),
        at,
        fault,
    };
    let bytes = match root.read(&json_path, MAX_DOCUMENT_BYTES) {
        Ok(bytes) => bytes,
        Err(ReadError::Missing) => {
            return match root.read(&yaml_path, MAX_DOCUMENT_BYTES) {
                Err(ReadError::Missing) => Ok(Decisions::default()),
                _ => Err(refused(&yaml_path, None, EditsFault::NoJson)),
            };
        }
        Err(error) => {
            let fault = EditsFault::Unreadable(error.to_string());
            return Err(refused(&json_path, None, fault));
        }
    };
    let document = json::read(&bytes).map_err(|unreadable| {
        let first = unreadable.faults.iter().next();
        let words = first.map_or_else(String::new, |fault| fault.message.clone());
        let at = first.and_then(|fault| fault.position);
        refused(&json_path, at, EditsFault::Unreadable(words))
    })?;
    let twice = document.faults.iter().find(|fault| {
        let pointer = fault.pointer.as_deref().unwrap_or_default();
        fault.kind == TextFaultKind::DuplicateKey && is_of_edits(pointer)
    });
    if let Some(twice) = twice {
        let fault = EditsFault::Unreadable(twice.message.clone());
        return Err(refused(&json_path, twice.position, fault));
    }
    let decisions = parse(&document.value).map_err(|(pointer, fault)| {
        let at = position::locate(&document.text, &pointer);
        refused(&json_path, at, fault)
    })?;
    if let Some((idx, link)) = unknown_link(&root, &decisions.edits) {
        let at = position::locate(&document.text, &format!("/{EDITS}/{idx}"));
        return Err(refused(&json_path, at, EditsFault::UnknownLink(link)));
    }
    // The user may have edited only the YAML file. A YAML file that is still as generated is merely out of date.
    if !is_as_made(replaced, &yaml_path)
        && let Ok(bytes) = root.read(&yaml_path, MAX_DOCUMENT_BYTES)
    {
        let faults = yaml::check_mirror(&bytes, &document.value);
        // Only the first of many differences are kept, and the edits may be among the rest.
        let is_cut = faults.total(TextFaultKind::YamlDiffers) > KEPT_PER_KIND;
        let differs = faults.iter().find(|fault| match fault.kind {
            TextFaultKind::YamlDiffers => {
                is_cut || is_of_edits(fault.pointer.as_deref().unwrap_or_default())
            }
            TextFaultKind::YamlSyntax | TextFaultKind::YamlNotUtf8 => true,
            _ => false,
        });
        if let Some(fault) = differs {
            let at = fault.position;
            return Err(refused(
                &yaml_path,
                at,
                EditsFault::Yaml(fault.message.clone()),
            ));
        }
    }
    if !decisions.edits.is_empty() && !selection.has(kind) {
        let fault = EditsFault::NotAskedFor(decisions.edits.len());
        return Err(refused(&json_path, None, fault));
    }
    Ok(decisions)
}

/// The first edit with a link that the URDD's own robot lacks, and the link: a mistyped name. A link that only the new
/// robot lacks is handled elsewhere.
fn unknown_link(root: &Root, edits: &[SkipEdit]) -> Option<(usize, String)> {
    if edits.is_empty() {
        return None;
    }
    let path = format!("{}/module.json", ModuleKind::Urdf.folder());
    let robot = json::read(&root.read(&path, MAX_DOCUMENT_BYTES).ok()?).ok()?;
    let links = robot.value.get("links")?.as_array()?;
    let names = links.iter().map(|link| link.get("name")?.as_str());
    let names = names.collect::<Option<HashSet<&str>>>()?;
    edits.iter().enumerate().find_map(|(idx, edit)| {
        let unknown = [&edit.link_a, &edit.link_b]
            .into_iter()
            .find(|name| !names.contains(name.as_str()))?;
        Some((idx, unknown.clone()))
    })
}

/// Whether a file matches the metadata of its URDD.
fn is_as_made(replaced: Option<&Donor>, path: &str) -> bool {
    let Some(replaced) = replaced else {
        return false;
    };
    let mut files = replaced
        .metadata
        .modules
        .iter()
        .flat_map(|module| &module.files);
    files
        .find(|file| file.path == path)
        .is_some_and(|file| replaced.is_intact(file))
}

fn is_of_edits(pointer: &str) -> bool {
    let first = pointer.split('/').nth(1);
    first.is_some_and(|key| key == EDITS || key == SKIPPED_REASONS)
}

/// The decisions in a document of any draft, or the JSON Pointer to an invalid one and what is wrong with it.
fn parse(document: &Value) -> Result<Decisions, (String, EditsFault)> {
    let skipped_reasons = match document.get(SKIPPED_REASONS) {
        // An early draft of the format had edits but no choice of reasons.
        None => SkippedReason::USUAL.to_vec(),
        Some(reasons) => serde_json::from_value(reasons.clone()).map_err(|error| {
            let words = format!("{SKIPPED_REASONS}: {error}");
            (format!("/{SKIPPED_REASONS}"), EditsFault::Edit(words))
        })?,
    };
    let Some(edits) = document.get(EDITS) else {
        return Err((String::new(), EditsFault::NoEdits));
    };
    let Some(edits) = edits.as_array() else {
        return Err((format!("/{EDITS}"), EditsFault::NotAList));
    };
    let edits = edits.iter().enumerate().map(|(idx, edit)| {
        let pointer = format!("/{EDITS}/{idx}");
        let is_null = |key: &str| edit.get(key).is_some_and(Value::is_null);
        let keys = ["link_a", "link_b", "skip", "reason"];
        if let Some(key) = keys.into_iter().find(|key| is_null(key)) {
            let words = format!("`{key}` is null");
            return Err((format!("{pointer}/{key}"), EditsFault::Edit(words)));
        }
        serde_json::from_value::<SkipEdit>(edit.clone())
            .map_err(|error| (pointer, EditsFault::Edit(error.to_string())))
    });
    Ok(Decisions {
        skipped_reasons,
        edits: edits.collect::<Result<_, _>>()?,
    })
}
