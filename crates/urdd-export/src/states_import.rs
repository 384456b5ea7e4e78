//! Imports the group states of an SRDF as named configurations.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::error::unknown;
use crate::srdf_document::elements;
use crate::{LeftOut, Srdf, SrdfError};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_robot::{Robot, RobotError};

/// The named configurations of a robot after an import.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedStates {
    /// The existing configurations, in their order, followed by new ones.
    pub configurations: Vec<ConfigurationEdit>,
    /// Number of configurations that were added or replaced.
    pub changed: usize,
    /// Number of configurations that the URDD has already.
    pub already: usize,
    /// Number of positions that were left out: of joints of several DOFs, or that have none or follow others.
    pub left_out: usize,
    /// States that were left out, each with a joint that is out of its bounds there.
    pub out_of_bounds: Vec<[String; 2]>,
    /// The elements of the SRDF that were left out, as MoveIt does: each with its line and what is wrong.
    pub wrong: Vec<String>,
}

/// Reads the `<group_state>`s of an SRDF. States of several groups with one name are one configuration. What is wrong in a
/// state, such as a joint that the robot does not have, is left out; the rest of the state is read.
///
/// # Errors
/// If the text is not an SRDF of the robot, or the URDD has another configuration of the name without `force`.
pub fn import_states(robot: &Robot, text: &str, force: bool) -> Result<ImportedStates, SrdfError> {
    let srdf = Srdf::of(text, &robot.description()?.name)?;
    let dofs: HashMap<&str, usize> =
        robot.dof_names()?.iter().map(String::as_str).zip(0..).collect();
    let joints: HashSet<&str> = robot.joint_names()?.iter().map(String::as_str).collect();
    let (mut left_out, mut wrong) = (0, LeftOut::new(&srdf));
    // In the order of their names in the file; positions by DOF.
    let mut states: Vec<(String, BTreeMap<usize, DofPosition>)> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for node in srdf.elements("group_state") {
        let Some(name) = wrong.attribute(node, "name") else {
            continue;
        };
        let place = *places.entry(name.to_owned()).or_insert(states.len());
        if place == states.len() {
            states.push((name.to_owned(), BTreeMap::new()));
        }
        let state = &mut states[place].1;
        for node in elements(node, "joint") {
            let (Some(joint), Some(value)) =
                (wrong.attribute(node, "name"), wrong.attribute(node, "value"))
            else {
                continue;
            };
            if !joints.contains(joint) {
                let names = robot.joint_names()?.iter().map(String::as_str);
                wrong.add(node, ("joint", joint), || unknown("joint", joint, names));
                continue;
            }
            let Some(dof) = dofs.get(joint) else {
                left_out += 1;
                continue;
            };
            let Some(position) = value.parse::<f64>().ok().filter(|value| value.is_finite()) else {
                let value = value.escape_debug().to_string();
                let reason = || format!("`{value}` is not a position, rad or m");
                wrong.add(node, ("position", &value), reason);
                continue;
            };
            let position = DofPosition { position, dof_name: joint.to_owned() };
            if state.get(dof).is_some_and(|before| *before != position) {
                let [name, joint] = [name, joint].map(str::escape_debug);
                let both = format!("{name} {joint}");
                wrong.add(node, ("twice", &both), || {
                    format!("another state `{name}` sets the joint `{joint}` to another position")
                });
                continue;
            }
            state.insert(*dof, position);
        }
    }
    states.retain(|(_, positions)| !positions.is_empty());
    let edits: Vec<ConfigurationEdit> = (states.into_iter())
        .filter_map(|(name, positions)| {
            let positions = positions.into_values().collect();
            ConfigurationName::new(&name).map(|name| ConfigurationEdit { name, positions })
        })
        .collect();
    let existing = robot.named_configurations()?;
    let mut imported = ImportedStates {
        configurations: existing.iter().map(ConfigurationEdit::from).collect(),
        changed: 0,
        already: 0,
        left_out,
        out_of_bounds: Vec::new(),
        wrong: wrong.in_words(),
    };
    let known: HashMap<&str, usize> =
        existing.iter().map(|named| named.name.as_str()).zip(0..).collect();
    for (edit, resolved) in edits.iter().zip(robot.resolved_configurations(&edits)?) {
        let name = edit.name.as_str();
        let configuration = match resolved {
            Ok(resolved) => resolved.configuration,
            Err(RobotError::OutOfBounds { dof, .. }) => {
                imported.out_of_bounds.push([name.to_owned(), dof]);
                continue;
            }
            Err(error) => return Err(error.into()),
        };
        match known.get(name) {
            Some(place) if existing[*place].configuration == configuration => imported.already += 1,
            Some(_) if !force => {
                let name = name.escape_debug();
                let other = format!("another configuration `{name}`; --force replaces it");
                return Err(SrdfError::Edited(other));
            }
            Some(place) => {
                imported.configurations[*place] = edit.clone();
                imported.changed += 1;
            }
            None => {
                imported.configurations.push(edit.clone());
                imported.changed += 1;
            }
        }
    }
    Ok(imported)
}
