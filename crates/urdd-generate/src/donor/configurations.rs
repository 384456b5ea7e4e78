//! The user's named configurations, which a new URDD takes over. Their values are computed again.

use std::collections::HashSet;
use std::path::Path;

use serde_json::Value;

use super::Donor;
use super::decided::Decided;
use crate::error::{EditsFault, GenerateError};
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::registry::ModuleKind;

/// Key of the configurations.
const CONFIGURATIONS: &str = "configurations";

/// What is wrong, with its JSON Pointer.
type Fault = (String, EditsFault);

/// Reads the named configurations from a folder that is to be replaced, whatever else is wrong with it.
///
/// # Errors
/// If there may be some and they cannot be read.
pub(crate) fn read(
    folder: &Path,
    replaced: Option<&Donor>,
) -> Result<Vec<ConfigurationEdit>, GenerateError> {
    let Ok(root) = Root::open(folder) else {
        return Ok(Vec::new());
    };
    let decided = Decided {
        root: &root,
        folder,
        kind: ModuleKind::NamedConfigurations,
        what: "named configurations",
        keys: &[CONFIGURATIONS],
    };
    let Some(document) = decided.document()? else {
        return Ok(Vec::new());
    };
    let edits = parse(&document.value).and_then(|edits| check(edits, dof_names(&root).as_ref()));
    let edits = edits.map_err(|(pointer, fault)| decided.fault(&document, &pointer, fault))?;
    decided.check_mirror(&document, replaced)?;
    Ok(edits)
}

/// The names and positions in the document.
fn parse(document: &Value) -> Result<Vec<ConfigurationEdit>, Fault> {
    let list = document.get(CONFIGURATIONS).and_then(Value::as_array);
    let Some(list) = list else {
        let words = format!("`{CONFIGURATIONS}` must be a list");
        return Err((String::new(), EditsFault::Configuration(words)));
    };
    let edits = list.iter().enumerate().map(|(idx, configuration)| {
        let read = |key: &str| {
            let pointer = format!("/{CONFIGURATIONS}/{idx}");
            match configuration.get(key) {
                Some(value) => Ok((format!("{pointer}/{key}"), value.clone())),
                None => {
                    let words = format!("`{key}` is missing");
                    Err((pointer, EditsFault::Configuration(words)))
                }
            }
        };
        let wrong = |pointer: String| {
            move |error: serde_json::Error| (pointer, EditsFault::Configuration(error.to_string()))
        };
        let (pointer, name) = read("name")?;
        let name: ConfigurationName = serde_json::from_value(name).map_err(wrong(pointer))?;
        let (pointer, positions) = read("positions")?;
        let positions: Vec<DofPosition> =
            serde_json::from_value(positions).map_err(wrong(pointer))?;
        Ok(ConfigurationEdit { name, positions })
    });
    edits.collect()
}

/// Checks that the edits are unambiguous, and name DOFs of the URDD's own robot. DOFs that only the new robot lacks are
/// handled elsewhere.
fn check(
    edits: Vec<ConfigurationEdit>,
    dofs: Option<&HashSet<String>>,
) -> Result<Vec<ConfigurationEdit>, Fault> {
    let mut names = HashSet::new();
    for (idx, edit) in edits.iter().enumerate() {
        let fault = |place: String, words: String| {
            let pointer = format!("/{CONFIGURATIONS}/{idx}/{place}");
            Err((pointer, EditsFault::Configuration(words)))
        };
        if !names.insert(&edit.name) {
            return fault("name".to_owned(), "an earlier one has this name".to_owned());
        }
        let mut set = HashSet::new();
        for (entry, position) in edit.positions.iter().enumerate() {
            let (name, place) = (&position.dof_name, format!("positions/{entry}"));
            if dofs.is_some_and(|dofs| !dofs.contains(name)) {
                let words = format!("the robot of this URDD has no DOF `{name}`");
                return fault(place, words);
            }
            if !set.insert(name) {
                return fault(place, format!("it sets the DOF `{name}` twice"));
            }
        }
    }
    Ok(edits)
}

/// The DOFs of the URDD's own robot, if they can be read.
fn dof_names(root: &Root) -> Option<HashSet<String>> {
    let path = format!("{}/module.json", ModuleKind::Dof.folder());
    let module = json::read(&root.read(&path, MAX_DOCUMENT_BYTES).ok()?).ok()?;
    let dofs = module.value.get("dofs")?.as_array()?;
    let names = dofs
        .iter()
        .map(|dof| Some(dof.get("name")?.as_str()?.to_owned()));
    names.collect()
}
