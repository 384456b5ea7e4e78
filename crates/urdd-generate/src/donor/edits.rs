//! The user's edits of the skip matrix (MoveIt's allowed collision matrix), named configurations and given spheres,
//! which a new URDD takes over. The values of configurations are computed again.
//!
//! They are read before any module is built.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Donor;
use super::decided::{Decided, Fault, names};
use crate::error::{EditsFault, Result};
use crate::selection::Selection;
use urdd_directory::root::Root;
use urdd_format::chain::ChainModule;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::named_configurations::ConfigurationEdit;
use urdd_format::registry::ModuleKind;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_spheres::list::SphereList;

const EDITS: &str = "edits";
const SKIPPED_REASONS: &str = "skipped_reasons";
const CONFIGURATIONS: &str = "configurations";
const LEVELS: &str = "levels";

#[derive(Debug, Clone)]
pub(crate) struct Decisions {
    pub skipped_reasons: Vec<SkippedReason>,
    pub edits: Vec<SkipEdit>,
    pub configurations: Vec<ConfigurationEdit>,
    /// Spheres that were given.
    pub spheres: Vec<SphereList>,
}

impl Default for Decisions {
    /// The defaults: the usual reasons, and nothing else.
    fn default() -> Self {
        Decisions {
            skipped_reasons: SkippedReason::USUAL.to_vec(),
            edits: Vec::new(),
            configurations: Vec::new(),
            spheres: Vec::new(),
        }
    }
}

/// The user's decisions about the skips, checked against the links of a robot.
#[derive(Debug, Clone, Default)]
pub(crate) struct Edits {
    pub skipped_reasons: Vec<SkippedReason>,
    /// Edits whose links the robot has.
    pub kept: Vec<SkipEdit>,
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
        Edits { skipped_reasons: decisions.skipped_reasons, kept, lost }
    }
}

impl Decisions {
    /// Reads the decisions from a folder that is to be replaced, whatever else is wrong with it.
    ///
    /// # Errors
    /// If there may be some and they cannot be read, or if the selected modules would not hold the edits.
    pub fn read(folder: &Path, selection: &Selection, replaced: Option<&Donor>) -> Result<Self> {
        let decided = Decided {
            folder,
            kind: ModuleKind::NamedConfigurations,
            what: "named configurations",
            keys: &[CONFIGURATIONS],
        };
        let configurations = decided.read(replaced, |root, document| {
            let dofs = known(root, ModuleKind::Dof, "dofs");
            let configurations = parse_configurations(document).and_then(|edits| {
                check_configurations(&edits, dofs.as_ref())?;
                Ok(edits)
            });
            configurations.map_err(|(pointer, words)| {
                (pointer, format!("this configuration cannot be used: {words}"))
            })
        })?;
        let decided = Decided {
            folder,
            kind: ModuleKind::LinkShapesSkips,
            what: "edits of skips",
            keys: &[EDITS, SKIPPED_REASONS],
        };
        let decisions = decided.read(replaced, |root, document| {
            let decisions = parse_edits(document)?;
            check_links(root, &decisions.edits)?;
            Ok(decisions)
        })?;
        let decisions = decisions.unwrap_or_default();
        if !decisions.edits.is_empty() && !selection.has(decided.kind) {
            let fault = EditsFault::NotAskedFor(decisions.edits.len());
            return Err(decided.refused(&decided.path("module.json"), None, fault));
        }
        let spheres = given_spheres(folder, selection, replaced)?;
        Ok(Decisions { configurations: configurations.unwrap_or_default(), spheres, ..decisions })
    }
}

fn known(root: &Root, kind: ModuleKind, list: &str) -> Option<HashSet<String>> {
    Some(names(root, kind, list)?.into_iter().collect())
}

/// Refuses an edit with a link that the URDD's own robot lacks: a mistyped name. A link that only the new robot lacks is
/// handled elsewhere.
fn check_links(root: &Root, edits: &[SkipEdit]) -> Result<(), Fault> {
    if edits.is_empty() {
        return Ok(());
    }
    let Some(links) = known(root, ModuleKind::Urdf, "links") else { return Ok(()) };
    for (idx, edit) in edits.iter().enumerate() {
        let mut named = [&edit.link_a, &edit.link_b].into_iter();
        if let Some(unknown) = named.find(|name| !links.contains(*name)) {
            let words = format!(
                "this edit names the link `{unknown}`, but the robot of this URDD has no such link"
            );
            return Err((format!("/{EDITS}/{idx}"), words));
        }
    }
    Ok(())
}

/// The decisions in a document of any draft, or the JSON Pointer to an invalid one and what is wrong with it.
fn parse_edits(document: &Value) -> Result<Decisions, Fault> {
    let skipped_reasons = match document.get(SKIPPED_REASONS) {
        // An early draft of the format had edits but no choice of reasons.
        None => SkippedReason::USUAL.to_vec(),
        Some(reasons) => Vec::deserialize(reasons).map_err(|error| {
            unusable(format!("/{SKIPPED_REASONS}"), format!("{SKIPPED_REASONS}: {error}"))
        })?,
    };
    let Some(edits) = document.get(EDITS) else {
        return Err((String::new(), format!("`{EDITS}` is missing")));
    };
    let Some(edits) = edits.as_array() else {
        return Err((format!("/{EDITS}"), format!("`{EDITS}` must be a list")));
    };
    let edits = edits.iter().enumerate().map(|(idx, edit)| {
        let pointer = format!("/{EDITS}/{idx}");
        let is_null = |key: &str| edit.get(key).is_some_and(Value::is_null);
        let keys = ["link_a", "link_b", "skip", "reason"];
        if let Some(key) = keys.into_iter().find(|key| is_null(key)) {
            return Err(unusable(format!("{pointer}/{key}"), format!("`{key}` is null")));
        }
        SkipEdit::deserialize(edit).map_err(|error| unusable(pointer, error.to_string()))
    });
    let edits = edits.collect::<Result<_, _>>()?;
    Ok(Decisions { skipped_reasons, edits, configurations: Vec::new(), spheres: Vec::new() })
}

fn unusable(pointer: String, why: String) -> Fault {
    (pointer, format!("this edit cannot be used: {why}"))
}

fn parse_configurations(document: &Value) -> Result<Vec<ConfigurationEdit>, Fault> {
    let Some(list) = document.get(CONFIGURATIONS).and_then(Value::as_array) else {
        return Err((String::new(), format!("`{CONFIGURATIONS}` must be a list")));
    };
    let edits = list.iter().enumerate().map(|(idx, configuration)| {
        let pointer = format!("/{CONFIGURATIONS}/{idx}");
        Ok(ConfigurationEdit {
            name: member(configuration, &pointer, "name")?,
            positions: member(configuration, &pointer, "positions")?,
        })
    });
    edits.collect()
}

fn member<T: DeserializeOwned>(of: &Value, pointer: &str, key: &str) -> Result<T, Fault> {
    let Some(value) = of.get(key) else {
        return Err((pointer.to_owned(), format!("`{key}` is missing")));
    };
    T::deserialize(value).map_err(|error| (format!("{pointer}/{key}"), error.to_string()))
}

/// Checks that the configurations are unambiguous, and name DOFs of the URDD's own robot. DOFs that only the new robot lacks are
/// handled elsewhere.
fn check_configurations(
    edits: &[ConfigurationEdit],
    dofs: Option<&HashSet<String>>,
) -> Result<(), Fault> {
    let mut names = HashSet::new();
    for (idx, edit) in edits.iter().enumerate() {
        let fault =
            |place: String, words: String| Err((format!("/{CONFIGURATIONS}/{idx}/{place}"), words));
        if !names.insert(&edit.name) {
            return fault("name".to_owned(), "an earlier one has this name".to_owned());
        }
        let mut set = HashSet::new();
        for (entry, position) in edit.positions.iter().enumerate() {
            let (name, place) = (&position.dof_name, format!("positions/{entry}"));
            if dofs.is_some_and(|dofs| !dofs.contains(name)) {
                return fault(place, format!("the robot of this URDD has no DOF `{name}`"));
            }
            if !set.insert(name) {
                return fault(place, format!("it sets the DOF `{name}` twice"));
            }
        }
    }
    Ok(())
}

/// The lists of spheres that a person gave to a folder that is to be replaced: SPEC 8.9.8.
///
/// # Errors
/// If there may be some and they cannot be read, or if the selected modules would not hold them.
fn given_spheres(
    folder: &Path,
    selection: &Selection,
    replaced: Option<&Donor>,
) -> Result<Vec<SphereList>> {
    let kind = ModuleKind::LinkShapesSpheres;
    let decided = Decided { folder, kind, what: "given spheres", keys: &[LEVELS] };
    let lists = decided.read(replaced, sphere_lists)?.unwrap_or_default();
    let count = lists.iter().map(SphereList::count).sum();
    if count > 0 && !selection.has(kind) {
        let fault = EditsFault::SpheresNotAskedFor(count);
        return Err(decided.refused(&decided.path("module.json"), None, fault));
    }
    Ok(lists)
}

fn sphere_lists(root: &Root, document: &Value) -> Result<Vec<SphereList>, Fault> {
    let at = |level: Option<usize>| match level {
        Some(level) => format!("/{LEVELS}/{level}"),
        None => format!("/{LEVELS}"),
    };
    let levels = document.get(LEVELS).and_then(Value::as_array);
    let levels = levels.ok_or_else(|| (at(None), "this list is missing".to_owned()))?;
    let mut lists = Vec::new();
    for (number, level) in levels.iter().enumerate() {
        let origin = level.get("origin").and_then(Value::as_str);
        if origin == Some("Computed") {
            continue;
        }
        let level = SphereLevel::deserialize(level).map_err(|error| {
            (at(Some(number)), format!("the spheres of this level cannot be used: {error}"))
        })?;
        if level.origin != SphereOrigin::Given {
            continue;
        }
        let names = names(root, ModuleKind::Urdf, "links").ok_or_else(|| {
            let words = "the spheres of this level cannot be used: urdf_module, which names their links, cannot be read";
            (at(Some(number)), words.to_owned())
        })?;
        let links = names.into_iter().zip(&level.spheres).filter(|(_, own)| !own.is_empty());
        let links = links.map(|(name, own)| {
            let one = own
                .iter()
                .map(|sphere| BoundingSphere { centre: sphere.offset_xyz, radius: sphere.radius });
            (name, one.collect())
        });
        lists.push(SphereList { links: links.collect(), left_out: Vec::new() });
    }
    Ok(lists)
}
