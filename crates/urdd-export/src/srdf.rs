//! SRDF of a robot: the pairs of links that MoveIt does not check, written, and read as skip edits; and group states, read as
//! named configurations. The package of MoveIt writes groups and other elements.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use thiserror::Error;

use crate::error::unknown;
use crate::pairs::{ascending, last_edits};
use crate::{Export, ExportError, LinkPair, Subject};
use urdd_format::link_shapes_simple_skips::SkipReason;
use urdd_format::link_shapes_skips::SkipEdit;
use urdd_format::named_configurations::{ConfigurationEdit, ConfigurationName, DofPosition};
use urdd_robot::{Robot, RobotError, ShapeKind};
use urdd_srdf::{LeftOut, ReadError, Srdf, elements};
use urdd_xml::Node;
use urdd_xml::writer::Element;

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let mut robot = Element::new("robot").with("name", subject.urdf.name.as_str());
    push_pairs(subject, &mut robot);
    let notes = subject.notes();
    let text = robot.document(&subject.comments(basis(subject)?, &notes)?);
    Ok(Export::of(text, Vec::new(), notes))
}

pub(super) fn push_pairs(subject: &Subject, robot: &mut Element) {
    robot.extend(subject.disabled().map(|pair| disabled(subject, pair)));
}

fn disabled(subject: &Subject, pair: &LinkPair) -> Element {
    let links = pair.links.map(|link| subject.links[link].as_str());
    urdd_srdf::write::disabled(links, reason(subject, pair))
}

/// The reason as MoveIt's Setup Assistant writes it: `Adjacent` for two links that a joint connects, even if they are
/// always in contact.
fn reason(subject: &Subject, pair: &LinkPair) -> &'static str {
    let [a, b] = pair.links;
    let parent = &subject.tree.parent_link;
    let adjacent = parent[a] == Some(b) || parent[b] == Some(a);
    match (&pair.edit, pair.reason) {
        (Some(_), _) => "User",
        (_, Some(SkipReason::Always)) if adjacent => "Adjacent",
        (_, Some(SkipReason::Always | SkipReason::SameLink)) => "Always",
        (_, Some(SkipReason::Adjacent)) => "Adjacent",
        (_, Some(SkipReason::Default)) => "Default",
        (_, Some(SkipReason::Never)) => "Never",
        // A pair of which only some shapes are skipped has no reason of its own.
        (_, Some(SkipReason::None) | None) => "User",
    }
}

pub(super) fn basis(subject: &Subject) -> Result<String, RobotError> {
    let shapes = subject.shapes;
    Ok(match subject.robot.num_samples()? {
        Some(samples) => {
            format!("Reasons by {shapes}; Always and Never by {samples} sampled configurations.")
        }
        None => format!("Reasons by {shapes}."),
    })
}

/// Errors of taking an SRDF into a URDD.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SrdfError {
    /// It cannot be read, or names what the robot does not have.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// What is read contradicts what a person wrote into the URDD.
    #[error("the URDD has {0}")]
    Edited(String),
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] ExportError),
}

impl From<RobotError> for SrdfError {
    fn from(error: RobotError) -> Self {
        SrdfError::Robot(error.into())
    }
}

/// A robot's edits after an SRDF import.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedSkips {
    /// The existing edits, in their order, followed by those of the SRDF.
    pub edits: Vec<SkipEdit>,
    /// Number of edits that the SRDF adds.
    pub added: usize,
    /// Number of pairs of the SRDF that need no edit.
    pub already: usize,
    /// Number of pairs that the URDD skips and the SRDF does not list: they stay skipped.
    pub unlisted: usize,
    /// The elements of the SRDF that were left out, as MoveIt does: each with its line and what is wrong.
    pub wrong: Vec<String>,
}

/// Reads an SRDF: `<disable_collisions>`, `<disable_default_collisions>` and `<enable_collisions>`, in the order in
/// which MoveIt applies them. Existing edits remain. If one contradicts the SRDF, `force` lets the SRDF override it. Elements
/// without a link, or with one that the robot does not have, are left out.
///
/// # Errors
/// If the text is not an SRDF of the robot, or contradicts an edit without `force`.
pub fn import_srdf(robot: &Robot, text: &str, force: bool) -> Result<ImportedSkips, SrdfError> {
    let srdf = Srdf::of(text, &robot.description()?.name)?;
    let links = robot.link_names()?;
    let by_name: HashMap<&str, usize> = links.iter().map(String::as_str).zip(0..).collect();
    let mut wrong = LeftOut::new(&srdf);
    let mut link = |node: Node, attribute: &'static str| {
        let name = wrong.attribute(node, attribute)?;
        let known = by_name.get(name).copied();
        if known.is_none() {
            let all = links.iter().map(String::as_str);
            wrong.add(node, ("link", name), || unknown("link", name, all));
        }
        known
    };
    // Pairs of links, lower index first: whether they are skipped, and why.
    let mut wanted: BTreeMap<[usize; 2], (bool, String)> = BTreeMap::new();
    let mut defaults = BTreeSet::new();
    for node in srdf.elements("disable_default_collisions") {
        defaults.extend(link(node, "link"));
    }
    for of in defaults {
        for other in (0..links.len()).filter(|other| *other != of) {
            wanted.insert(ascending(of, other), (true, "SRDF: default".to_owned()));
        }
    }
    for (name, skip) in [("enable_collisions", false), ("disable_collisions", true)] {
        for node in srdf.elements(name) {
            let (Some(a), Some(b)) = (link(node, "link1"), link(node, "link2")) else { continue };
            let reason = match node.attribute("reason") {
                Some(reason) if !reason.trim().is_empty() => format!("SRDF: {}", reason.trim()),
                _ => "SRDF".to_owned(),
            };
            if a != b {
                wanted.insert(ascending(a, b), (skip, reason));
            }
        }
    }
    let now = skipped_now(robot)?;
    let there = robot.skips(ShapeKind::Hulls)?.edits().to_vec();
    let last = last_edits(&there, links);
    let mut imported = ImportedSkips {
        edits: there.clone(),
        added: 0,
        already: 0,
        unlisted: 0,
        wrong: wrong.in_words(),
    };
    for (pair, (skip, reason)) in &wanted {
        // A link without shapes needs no edit.
        let Some(all_are) = now.get(pair) else { continue };
        if *all_are == Some(*skip) {
            imported.already += 1;
            continue;
        }
        if let Some(edit) = last.get(pair).filter(|_| !force) {
            let [a, b, reason] =
                [&edit.link_a, &edit.link_b, &edit.reason].map(|text| text.escape_debug());
            return Err(SrdfError::Edited(format!(
                "an edit of `{a}` and `{b}` that contradicts the SRDF (\"{reason}\"); --force lets the SRDF decide"
            )));
        }
        imported.added += 1;
        imported.edits.push(SkipEdit {
            link_a: links[pair[0]].clone(),
            link_b: links[pair[1]].clone(),
            skip: *skip,
            reason: reason.clone(),
        });
    }
    let unlisted = now.iter().filter(|(pair, skipped)| {
        **skipped == Some(true) && !wanted.get(*pair).is_some_and(|(skip, _)| *skip)
    });
    imported.unlisted = unlisted.count();
    Ok(imported)
}

/// For each pair of links with shapes: true if all their pairs of shapes, of all kinds, are skipped, false if none is,
/// `None` if some are.
fn skipped_now(robot: &Robot) -> Result<BTreeMap<[usize; 2], Option<bool>>, RobotError> {
    let mut found: BTreeMap<[usize; 2], BTreeSet<bool>> = BTreeMap::new();
    for kind in ShapeKind::ALL {
        let skips = robot.skips(kind)?;
        let places = skips.places();
        for i in 0..places.len() {
            for j in 0..i {
                let of = ascending(places[i].0, places[j].0);
                if of[0] != of[1] {
                    found.entry(of).or_default().insert(skips.is_skipped(i, j));
                }
            }
        }
    }
    let all = found.into_iter().map(|(pair, said)| {
        let one = (said.len() == 1).then(|| said.contains(&true));
        (pair, one)
    });
    Ok(all.collect())
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
        let Some(name) = wrong.attribute(node, "name") else { continue };
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
