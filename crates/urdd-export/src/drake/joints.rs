//! Joints in a form that Drake's URDF parser accepts.
//!
//! Drake names a spherical joint `ball`, and supports floating joints only below the world. Any other floating joint
//! becomes three prismatic joints and a ball joint, with massless links between them. Drake aborts if a lower limit
//! exceeds its upper limit, and applies the limits of a continuous joint.

use crate::joints::coupled;
use crate::names::check_unique;
use crate::urdf_elements::{element_of_joint, type_name};
use crate::{ExportError, Moves, Note, Structure, Subject};
use urdd_document::robot::{Joint as View, Origin as ViewOrigin};
use urdd_format::urdf::{Axis, Joint, JointType, LinkName, Origin};
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

const CROSSED: &str =
    "its lower limit is above its upper one, at which Drake stops; it has no range";
const NEGATIVE: &str =
    "a negative velocity, acceleration, effort or damping, which Drake refuses, is left out";
const DAMPING: &str = "Drake expects three damping values of a planar joint; it has none";
const FRAME: &str = "Drake gives it to the frame of a joint";
const FLOATING: &str = "Drake allows floating joints only at the world; it is exported as three prismatic joints and a ball joint, with massless links between them";

/// The elements that represent the joints.
#[derive(Default)]
pub(super) struct DrakeJoints<'a> {
    /// The names of added links.
    pub links: Vec<String>,
    /// The frames on links.
    pub frames: Vec<Element>,
    /// The elements, each with its source joint.
    pub elements: Vec<(Element, &'a Joint)>,
    /// The names of the joints that an actuator can drive, and those of fixed joints.
    pub driven: Driven,
}

/// Joint names by whether an actuator can drive them.
#[derive(Default)]
pub(super) struct Driven {
    /// Joints of one DOF.
    pub of_one: Vec<String>,
    /// Fixed joints.
    pub fixed: Vec<String>,
}

pub(super) fn joints<'a>(
    subject: &'a Subject,
    notes: &mut Vec<Note>,
) -> Result<DrakeJoints<'a>, ExportError> {
    let mut made = DrakeJoints::default();
    let mut names = Vec::new();
    let sources = subject.urdf.joints.iter().zip(&subject.view.joints).zip(&subject.names.parts);
    let each = coupled(subject, notes)?.into_iter().zip(sources).enumerate();
    for (index, (mut joint, ((source, view), parts))) in each {
        if subject.is_of_frame(index) {
            made.frames.push(frame(&joint));
            continue;
        }
        clean(&mut joint, view, notes);
        let parts = match joint.joint_type {
            JointType::Floating if !is_free(subject, view) => {
                notes.push(Note::joint(&joint.name, FLOATING));
                let parts = chain(&joint, parts);
                let between = parts.iter().take(parts.len() - 1);
                made.links.extend(between.map(|part| part.child.link.clone()));
                parts
            }
            _ => vec![joint.clone()],
        };
        for part in parts {
            let (tag, kind) = match part.joint_type {
                JointType::Spherical => ("drake:joint", "ball".to_owned()),
                JointType::Planar => ("drake:joint", type_name(JointType::Planar)),
                standard => ("joint", type_name(standard)),
            };
            made.elements.push((element_of_joint(&part, tag, &kind), source));
            names.push(part.name);
        }
        match joint.joint_type {
            JointType::Fixed => made.driven.fixed.push(joint.name),
            JointType::Revolute | JointType::Continuous | JointType::Prismatic => {
                made.driven.of_one.push(joint.name);
            }
            JointType::Planar | JointType::Spherical | JointType::Floating => {}
        }
    }
    // Each link has a frame, and each joint adds one.
    let frames: Vec<String> = names.iter().map(|name| format!("{name}_parent")).collect();
    let links = subject.links.iter().chain(&made.links).chain(&frames);
    check_unique(subject.format, "link", links.map(String::as_str), FRAME)?;
    Ok(made)
}

/// A frame on a link, as Drake's own element says it.
fn frame(joint: &Joint) -> Element {
    let of = |of: fn(&Origin) -> Option<[f64; 3]>| {
        numbers(&joint.origin.as_ref().and_then(of).unwrap_or_default())
    };
    let frame = Element::new("frame").with("name", joint.child.link.as_str());
    let frame = frame.with("link", joint.parent.link.as_str());
    frame.with("xyz", of(|origin| origin.xyz)).with("rpy", of(|origin| origin.rpy))
}

/// Whether Drake supports a floating joint: its child moves freely in the world.
pub(in super::super) fn is_free(of: &Structure, view: &View) -> bool {
    let root = &of.view.links[of.tree.root].name;
    root == "world" && view.parent == *root && view.origin == ViewOrigin::default()
}

/// Removes what Drake rejects.
fn clean(joint: &mut Joint, view: &View, notes: &mut Vec<Note>) {
    let mut note = |what| notes.push(Note::joint(&view.name, what));
    let mut is_negative = false;
    let mut positive = |value: &mut Option<f64>| {
        if value.is_some_and(|value| value < 0.0) {
            is_negative = true;
            *value = None;
        }
    };
    if let Some(dynamics) = &mut joint.dynamics {
        positive(&mut dynamics.damping);
    }
    if let Some(limit) = &mut joint.limit {
        positive(&mut limit.velocity);
        positive(&mut limit.acceleration);
        positive(&mut limit.effort);
        let range = match view.position_limits() {
            Some((lower, upper)) if lower > upper => {
                note(CROSSED);
                None
            }
            range => range,
        };
        (limit.lower, limit.upper) = range.unzip();
    }
    if is_negative {
        note(NEGATIVE);
    }
    if joint.joint_type == JointType::Planar && joint.dynamics.take().is_some() {
        note(DAMPING);
    }
}

/// Splits a floating joint into its parts, from its parent to its child.
fn chain(joint: &Joint, parts: &[(String, Moves)]) -> Vec<Joint> {
    let mut parent = joint.parent.clone();
    let mut origin = joint.origin.clone();
    let mut chain = Vec::new();
    for (name, moves) in parts {
        let Moves::Slides(axis) = moves else {
            continue;
        };
        let child = LinkName { link: name.clone() };
        chain.push(Joint {
            name: name.clone(),
            joint_type: JointType::Prismatic,
            origin: origin.take(),
            parent: std::mem::replace(&mut parent, child.clone()),
            child,
            axis: Some(Axis { xyz: Some((*axis).into()) }),
            limit: None,
            dynamics: None,
            safety_controller: None,
            calibration: None,
            ..joint.clone()
        });
    }
    chain.push(Joint { joint_type: JointType::Spherical, origin: None, parent, ..joint.clone() });
    chain
}
