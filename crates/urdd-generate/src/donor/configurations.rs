//! The user's named configurations, which a new URDD takes over. Their values are computed again.

use std::collections::HashSet;
use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Donor;
use super::decided::{Decided, Fault, names};
use crate::error::GenerateError;
use urdd_format::named_configurations::ConfigurationEdit;
use urdd_format::registry::ModuleKind;

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
        parse(document).and_then(|edits| check(edits, dofs.as_ref())).map_err(|(pointer, words)| {
            (pointer, format!("this configuration cannot be used: {words}"))
        })
    })?;
    Ok(edits.unwrap_or_default())
}

fn parse(document: &Value) -> Result<Vec<ConfigurationEdit>, Fault> {
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

/// Checks that the edits are unambiguous, and name DOFs of the URDD's own robot. DOFs that only the new robot lacks are
/// handled elsewhere.
fn check(
    edits: Vec<ConfigurationEdit>,
    dofs: Option<&HashSet<String>>,
) -> Result<Vec<ConfigurationEdit>, Fault> {
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
    Ok(edits)
}
