//! Imports the group states of an SRDF as named configurations.

use std::collections::{BTreeMap, HashMap, HashSet};

use roxmltree::Node;
use thiserror::Error;

use super::srdf_merge::{SrdfError, elements, parse_of};
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_format::nearest::nearest;
use urdd_robot::{Robot, RobotError};

/// Errors of an import of group states.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StatesError {
    /// Not an SRDF, or the SRDF of another robot.
    #[error(transparent)]
    Srdf(#[from] SrdfError),
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// An element lacks an attribute, or has one that is wrong.
    #[error("line {line}: {fault}")]
    Element {
        /// The line, from 1.
        line: u32,
        /// What is wrong.
        fault: StateFault,
    },
    /// The URDD has another configuration of this name.
    #[error("the URDD has another configuration `{}`; --force replaces it", .0.escape_debug())]
    Other(String),
}

/// What is wrong with a group state.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum StateFault {
    /// An attribute is missing or empty.
    #[error("`<{element}>` has no `{attribute}`")]
    Missing {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// The robot has no such joint.
    #[error("the robot has no joint `{}`{}", .joint.escape_debug(), .nearest.as_ref().map_or(String::new(), |near| format!("; did you mean `{}`?", near.escape_debug())))]
    NoJoint {
        /// Its name.
        joint: String,
        /// The nearest name that there is.
        nearest: Option<String>,
    },
    /// Not a number.
    #[error("`{}` is not a position, rad or m", .0.escape_debug())]
    NotANumber(String),
    /// Two groups have states of one name that set a joint differently.
    #[error("another state `{}` sets the joint `{}` to another position", .state.escape_debug(), .joint.escape_debug())]
    Conflict {
        /// The name of the states.
        state: String,
        /// The joint.
        joint: String,
    },
}

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
pub fn import_states(
    robot: &Robot,
    text: &str,
    force: bool,
) -> Result<ImportedStates, StatesError> {
    let document = parse_of(text, &robot.description()?.name)?;
    let root = document.root_element();
    let dofs: HashMap<&str, usize> =
        robot.dof_names()?.iter().map(String::as_str).zip(0..).collect();
    let joints: HashSet<&str> = robot.joint_names()?.iter().map(String::as_str).collect();
    // Called only for errors: each call counts lines from the beginning of the text.
    let wrong = |node: Node, fault: StateFault| StatesError::Element {
        line: document.text_pos_at(node.range().start).row,
        fault,
    };
    let attribute = |node: Node<'_, '_>, element: &'static str, attribute: &'static str| {
        let value = node.attribute(attribute).filter(|value| !value.is_empty());
        let missing = || wrong(node, StateFault::Missing { element, attribute });
        value.map(str::to_owned).ok_or_else(missing)
    };
    let mut left_out = 0;
    // In the order of their names in the file; positions by DOF.
    let mut states: Vec<(String, BTreeMap<usize, DofPosition>)> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for node in elements(root, "group_state") {
        let name = attribute(node, "group_state", "name")?;
        let place = *places.entry(name.clone()).or_insert(states.len());
        if place == states.len() {
            states.push((name.clone(), BTreeMap::new()));
        }
        let state = &mut states[place].1;
        for node in elements(node, "joint") {
            let joint = attribute(node, "joint", "name")?;
            let value = attribute(node, "joint", "value")?;
            if !joints.contains(joint.as_str()) {
                let nearest = nearest(robot.joint_names()?.iter().map(String::as_str), &joint);
                return Err(wrong(node, StateFault::NoJoint { joint, nearest }));
            }
            let Some(dof) = dofs.get(joint.as_str()) else {
                left_out += 1;
                continue;
            };
            let number = value.trim().parse::<f64>().ok();
            let number = number.filter(|value| value.is_finite());
            let position = DofPosition {
                position: number.ok_or_else(|| wrong(node, StateFault::NotANumber(value)))?,
                dof_name: joint.clone(),
            };
            let before = state.insert(*dof, position.clone());
            if before.is_some_and(|before| before != position) {
                return Err(wrong(node, StateFault::Conflict { state: name, joint }));
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
            Some(_) if !force => return Err(StatesError::Other(name.to_owned())),
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
