//! The user's edits of the skip matrix (MoveIt's allowed collision matrix), which a new URDD takes over.
//!
//! They are read before any module is built.

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value;

use super::Donor;
use super::decided::Decided;
use crate::error::{EditsFault, GenerateError};
use crate::selection::Selection;
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::chain::ChainModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::named_configurations::ConfigurationEdit;
use urdd_format::registry::ModuleKind;

/// Key of the edits.
const EDITS: &str = "edits";
/// Key of the reasons for which pairs are skipped.
const SKIPPED_REASONS: &str = "skipped_reasons";

/// The user's decisions in a URDD.
#[derive(Debug, Clone)]
pub(crate) struct Decisions {
    /// The reasons for which pairs are skipped.
    pub skipped_reasons: Vec<SkippedReason>,
    /// The edits.
    pub edits: Vec<SkipEdit>,
    /// The named configurations.
    pub configurations: Vec<ConfigurationEdit>,
}

impl Default for Decisions {
    /// The defaults: the usual reasons, and nothing else.
    fn default() -> Self {
        Decisions {
            skipped_reasons: SkippedReason::USUAL.to_vec(),
            edits: Vec::new(),
            configurations: Vec::new(),
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
    let decided = Decided {
        root: &root,
        folder,
        kind: ModuleKind::LinkShapesSkips,
        what: "edits of skips",
        keys: &[EDITS, SKIPPED_REASONS],
    };
    let Some(document) = decided.document()? else {
        return Ok(Decisions::default());
    };
    let decisions = parse(&document.value)
        .map_err(|(pointer, fault)| decided.fault(&document, &pointer, fault))?;
    if let Some((idx, link)) = unknown_link(&root, &decisions.edits) {
        let pointer = format!("/{EDITS}/{idx}");
        return Err(decided.fault(&document, &pointer, EditsFault::UnknownLink(link)));
    }
    decided.check_mirror(&document, replaced)?;
    if !decisions.edits.is_empty() && !selection.has(decided.kind) {
        let fault = EditsFault::NotAskedFor(decisions.edits.len());
        return Err(decided.refused(&decided.path("module.json"), None, fault));
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
        configurations: Vec::new(),
    })
}
