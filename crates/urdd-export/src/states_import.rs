//! Imports the group states of an SRDF as named configurations.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::error::unknown;
use super::srdf_document::{Srdf, SrdfError, elements};
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
}

/// Reads the `<group_state>`s of an SRDF. States of several groups with one name are one configuration.
///
/// # Errors
/// If the text is not an SRDF of the robot, a state is wrong, or the URDD has another configuration of the name without
/// `force`.
pub fn import_states(robot: &Robot, text: &str, force: bool) -> Result<ImportedStates, SrdfError> {
    let srdf = Srdf::of(text, &robot.description()?.name)?;
    let dofs: HashMap<&str, usize> =
        robot.dof_names()?.iter().map(String::as_str).zip(0..).collect();
    let joints: HashSet<&str> = robot.joint_names()?.iter().map(String::as_str).collect();
    let mut left_out = 0;
    // In the order of their names in the file; positions by DOF.
    let mut states: Vec<(String, BTreeMap<usize, DofPosition>)> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for node in srdf.elements("group_state") {
        let name = srdf.attribute(node, "name")?;
        let place = *places.entry(name.to_owned()).or_insert(states.len());
        if place == states.len() {
            states.push((name.to_owned(), BTreeMap::new()));
        }
        let state = &mut states[place].1;
        for node in elements(node, "joint") {
            let joint = srdf.attribute(node, "name")?;
            let value = srdf.attribute(node, "value")?;
            if !joints.contains(joint) {
                let names = robot.joint_names()?.iter().map(String::as_str);
                return Err(srdf.wrong(node, unknown("joint", joint, names)));
            }
            let Some(dof) = dofs.get(joint) else {
                left_out += 1;
                continue;
            };
            let number = value.trim().parse::<f64>().ok().filter(|value| value.is_finite());
            let position = number.ok_or_else(|| {
                let value = value.escape_debug();
                srdf.wrong(node, format!("`{value}` is not a position, rad or m"))
            })?;
            let position = DofPosition { position, dof_name: joint.to_owned() };
            let before = state.insert(*dof, position.clone());
            if before.is_some_and(|before| before != position) {
                let [name, joint] = [name, joint].map(str::escape_debug);
                let reason =
                    format!("another state `{name}` sets the joint `{joint}` to another position");
                return Err(srdf.wrong(node, reason));
            }
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
