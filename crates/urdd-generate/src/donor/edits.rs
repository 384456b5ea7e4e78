//! The user's edits of the skip matrix (MoveIt's allowed collision matrix), named configurations and given spheres,
//! which a new URDD takes over. The values of configurations are computed again.
//!
//! They are read before any module is built. If they cannot be read, generation fails: a syntax error must not discard a
//! user's work.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Donor;
use crate::error::{EditsFault, GenerateError, Result};
use crate::selection::Selection;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::position::Position;
use urdd_directory::position::{KEPT_PER_KIND, TextFaultKind};
use urdd_directory::root::{ReadError, Root};
use urdd_directory::{json, position, yaml};
use urdd_format::chain::ChainModule;
use urdd_format::escape;
use urdd_format::link_shapes_skips::{SkipEdit, SkippedReason};
use urdd_format::link_shapes_spheres::{SphereLevel, SphereOrigin};
use urdd_format::named_configurations::ConfigurationEdit;
use urdd_format::registry::ModuleKind;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_spheres::model::SphereList;

const EDITS: &str = "edits";
const SKIPPED_REASONS: &str = "skipped_reasons";
const CONFIGURATIONS: &str = "configurations";
const LEVELS: &str = "levels";

#[derive(Debug, Clone)]
pub(crate) struct Decisions {
    pub skipped_reasons: Vec<SkippedReason>,
    pub edits: Vec<SkipEdit>,
    pub configurations: Vec<ConfigurationEdit>,
    pub spheres: Vec<SphereList>,
}

impl Default for Decisions {
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

/// A module with decisions, in a folder that is to be replaced.
struct Decided<'a> {
    folder: &'a Path,
    kind: ModuleKind,
    /// What the decisions are, for messages.
    what: &'static str,
    /// The members of its document that hold the decisions.
    keys: &'a [&'a str],
}

/// What is wrong with a document, with its JSON Pointer.
pub(super) type Fault = (String, String);

impl Decided<'_> {
    /// The decisions, whatever else is wrong with the URDD; `None` if there is no such module. `parse` reads them from the
    /// document. The URDD is `replaced` if its root metadata is readable.
    /// Fails if there may be some and they cannot be read.
    fn read<T>(
        &self,
        replaced: Option<&Donor>,
        parse: impl FnOnce(&Root, &Value) -> Result<T, Fault>,
    ) -> Result<Option<T>> {
        let Ok(root) = Root::open(self.folder) else { return Ok(None) };
        let Some((value, text)) = self.document(&root)? else { return Ok(None) };
        let decisions = parse(&root, &value).map_err(|(pointer, fault)| {
            let at = position::locate(&text, &pointer);
            self.unusable(&self.path("module.json"), at, fault)
        })?;
        self.check_mirror(&root, &value, replaced)?;
        Ok(Some(decisions))
    }

    /// The value of the document, and its text; `None` if there is no such module.
    fn document(&self, root: &Root) -> Result<Option<(Value, String)>> {
        let (json_path, yaml_path) = (self.path("module.json"), self.path("module.yaml"));
        let bytes = match root.read(&json_path, MAX_DOCUMENT_BYTES) {
            Ok(bytes) => bytes,
            Err(ReadError::Missing) => {
                if let Err(ReadError::Missing) = root.read(&yaml_path, MAX_DOCUMENT_BYTES) {
                    return Ok(None);
                }
                let words = "this file may contain edits, but module.json is missing beside it";
                return Err(self.unusable(&yaml_path, None, words.to_owned()));
            }
            Err(error) => return Err(self.unreadable(&json_path, None, &error.to_string())),
        };
        let document = json::read(&bytes).map_err(|unreadable| {
            let first = unreadable.faults.iter().next();
            let words = first.map_or("", |fault| &fault.message);
            self.unreadable(&json_path, first.and_then(|fault| fault.position), words)
        })?;
        let twice = document.faults.iter().find(|fault| {
            let pointer = fault.pointer.as_deref().unwrap_or_default();
            fault.kind == TextFaultKind::DuplicateKey && self.is_of_decisions(pointer)
        });
        if let Some(twice) = twice {
            return Err(self.unreadable(&json_path, twice.position, &twice.message));
        }
        Ok(Some((document.value, document.text.to_string())))
    }

    /// Checks that the YAML file says the same. The user may have edited only that one. A YAML file that is still as
    /// generated is merely out of date.
    fn check_mirror(&self, root: &Root, document: &Value, replaced: Option<&Donor>) -> Result<()> {
        let path = self.path("module.yaml");
        if is_as_made(replaced, &path) {
            return Ok(());
        }
        let Ok(bytes) = root.read(&path, MAX_DOCUMENT_BYTES) else { return Ok(()) };
        let faults = yaml::check_mirror(&bytes, document);
        // Only the first of many differences are kept, and those of decisions may be among the rest.
        let is_cut = faults.total(TextFaultKind::YamlDiffers) > KEPT_PER_KIND;
        let differs = faults.iter().find(|fault| match fault.kind {
            TextFaultKind::YamlDiffers => {
                is_cut || self.is_of_decisions(fault.pointer.as_deref().unwrap_or_default())
            }
            TextFaultKind::YamlSyntax | TextFaultKind::YamlNotUtf8 => true,
            _ => false,
        });
        let Some(fault) = differs else { return Ok(()) };
        let words = &fault.message;
        let words = format!("this file differs from module.json, which takes precedence: {words}");
        Err(self.unusable(&path, fault.position, words))
    }

    fn path(&self, file: &str) -> String {
        format!("{}/{file}", self.kind.folder())
    }

    fn refused(&self, path: &str, at: Option<Position>, fault: EditsFault) -> GenerateError {
        GenerateError::Edits { file: self.folder.join(path), at, lost: self.what, fault }
    }

    fn unusable(&self, path: &str, at: Option<Position>, words: String) -> GenerateError {
        self.refused(path, at, EditsFault::Unusable(escape::line(&words).into_owned()))
    }

    fn unreadable(&self, path: &str, at: Option<Position>, words: &str) -> GenerateError {
        self.unusable(path, at, format!("the file cannot be read: {words}"))
    }

    fn is_of_decisions(&self, pointer: &str) -> bool {
        pointer.split('/').nth(1).is_some_and(|key| self.keys.contains(&key))
    }
}

fn is_as_made(replaced: Option<&Donor>, path: &str) -> bool {
    let Some(replaced) = replaced else { return false };
    let mut files = replaced.metadata.modules.iter().flat_map(|module| &module.files);
    files.find(|file| file.path == path).is_some_and(|file| replaced.is_intact(file))
}

/// The names in a list of a module of the URDD, in its order, if they can be read.
pub(super) fn names(root: &Root, kind: ModuleKind, list: &str) -> Option<Vec<String>> {
    let path = format!("{}/module.json", kind.folder());
    let module = json::read(&root.read(&path, MAX_DOCUMENT_BYTES).ok()?).ok()?;
    let listed = module.value.get(list)?.as_array()?;
    listed.iter().map(|of| Some(of.get("name")?.as_str()?.to_owned())).collect()
}
