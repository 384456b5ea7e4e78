//! The user's named configurations, which a new URDD takes over. Their values are computed again.

use std::collections::HashSet;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use super::Donor;
use super::decided::{Decided, Fault, names};
use crate::error::{EditsFault, GenerateError};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::registry::ModuleKind;

/// Key of the configurations.
const CONFIGURATIONS: &str = "configurations";

/// Reads the named configurations from a folder that is to be replaced, whatever else is wrong with it.
///
/// # Errors
/// If there may be some and they cannot be read.
pub(crate) fn read(
    folder: &Path,
    replaced: Option<&Donor>,
) -> Result<Vec<ConfigurationEdit>, GenerateError> {
    let decided = Decided {
        folder,
        kind: ModuleKind::NamedConfigurations,
        what: "named configurations",
        keys: &[CONFIGURATIONS],
    };
    let edits = decided.read(replaced, |root, document| {
        let dofs = names(root, ModuleKind::Dof, "dofs");
        check(parse(document)?, dofs.as_ref())
    })?;
    Ok(edits.unwrap_or_default())
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
        let name = ConfigurationName::deserialize(&name).map_err(wrong(pointer))?;
        let (pointer, positions) = read("positions")?;
        let positions: Vec<DofPosition> = Vec::deserialize(&positions).map_err(wrong(pointer))?;
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
