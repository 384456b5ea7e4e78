//! Joints, loops and transmissions in a form that Drake's URDF parser accepts.
//!
//! Drake names a spherical joint `ball`, and supports floating joints only below the world. Any other floating joint
//! becomes three prismatic joints and a ball joint, with massless links between them. Drake aborts if a lower limit
//! exceeds its upper limit, and applies the limits of a continuous joint.
//!
//! Kinematic loops are ball constraints: Drake's parser has no others that hold two bodies together. A ball is one of them, a
//! hinge two on its axis, and a weld three that are not on a line.

use std::collections::HashSet;

use nalgebra::Point3;

use crate::joints::{APART, LeftOut, OTHER_KIND, closings, coupled, range};
use crate::names::check_unique;
use crate::urdf_elements::{element_of_joint, type_name};
use crate::{ExportError, Moves, Note, Structure, Subject, Taken};
use urdd_document::robot::{Joint as View, Origin as ViewOrigin};
use urdd_format::loops::LoopKind;
use urdd_format::urdf::{Axis, Joint, JointType, LinkName, Origin};
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;
use urdd_xml::{Kind, Node};

const CROSSED: &str =
    "its lower limit is above its upper one, at which Drake stops; it has no range";
const NEGATIVE: &str =
    "a negative velocity, acceleration, effort or damping, which Drake refuses, is left out";
const DAMPING: &str = "Drake expects three damping values of a planar joint; it has none";
const FRAME: &str = "Drake gives it to the frame of a joint";
const FLOATING: &str = "Drake allows floating joints only at the world; it is exported as three prismatic joints and a ball joint, with massless links between them";

#[derive(Default)]
pub(super) struct DrakeJoints<'a> {
    /// The names of added links.
    pub links: Vec<String>,
    pub frames: Vec<Element>,
    pub elements: Vec<(Element, &'a Joint)>,
    pub driven: Driven,
}

/// Joint names by whether an actuator can drive them.
#[derive(Default)]
pub(super) struct Driven {
    pub of_one: Vec<String>,
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
pub(crate) fn is_free(of: &Structure, view: &View) -> bool {
    let root = &of.view.links[of.tree.root].name;
    root == "world" && view.parent == *root && view.origin == ViewOrigin::default()
}

/// Removes what Drake rejects.
fn clean(joint: &mut Joint, view: &View, notes: &mut Vec<Note>) {
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
        (limit.lower, limit.upper) = range(view, CROSSED, notes).unzip();
    }
    if is_negative {
        notes.push(Note::joint(&view.name, NEGATIVE));
    }
    if joint.joint_type == JointType::Planar && joint.dynamics.take().is_some() {
        notes.push(Note::joint(&view.name, DAMPING));
    }
}

/// Splits a floating joint into its parts, from its parent to its child.
fn chain(joint: &Joint, parts: &[(String, Moves)]) -> Vec<Joint> {
    let mut parent = joint.parent.clone();
    let mut origin = joint.origin.clone();
    let mut chain = Vec::new();
    for (name, moves) in parts {
        let Moves::Slides(axis) = moves else { continue };
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

const SAP: &str = "ball constraints hold loops in simulation, with the solver SAP: Drake refuses the file for `DiscreteContactApproximation.kTamsi`";
const WORLD: &str = "Drake's constraints find no `world` in the model";

pub(super) fn constraints(
    subject: &Subject,
    notes: &mut Vec<Note>,
) -> Result<Vec<Element>, ExportError> {
    let mut left_out = LeftOut::default();
    let mut made = Vec::new();
    for closing in closings(subject, &mut left_out)? {
        let points = match closing.of.kind {
            LoopKind::Spherical => &[[0.0, 0.0, 0.0]][..],
            LoopKind::Revolute => &[[0.0, 0.0, 0.0], [0.0, 0.0, APART]],
            LoopKind::Fixed => &[[0.0, 0.0, 0.0], [APART, 0.0, 0.0], [0.0, APART, 0.0]],
            _ => {
                left_out.of_loop(&closing.of.name, OTHER_KIND);
                continue;
            }
        };
        if closing.ends.iter().any(|end| subject.is_world(end.link)) {
            left_out.of_loop(&closing.of.name, WORLD);
            continue;
        }
        let [a, b] = closing.ends;
        for point in points {
            let at = |key: &'static str, end: crate::layout::Place| {
                let point = end.pose * Point3::from(*point);
                Element::new(key).with("value", numbers(point.coords.as_slice()))
            };
            let body = |key: &'static str, link: usize| {
                Element::new(key).with("name", subject.links[link].as_str())
            };
            made.push(
                Element::new("drake:ball_constraint")
                    .holding(body("drake:ball_constraint_body_A", a.link))
                    .holding(body("drake:ball_constraint_body_B", b.link))
                    .holding(at("drake:ball_constraint_p_AP", a))
                    .holding(at("drake:ball_constraint_p_BQ", b)),
            );
        }
    }
    notes.extend(left_out.notes());
    if !made.is_empty() {
        notes.push(Note::Robot(SAP));
    }
    Ok(made)
}

/// Elements directly under `robot`, without those that Drake rejects.
pub(super) struct Kept {
    pub texts: Vec<String>,
    /// The joints that have an actuator, and the names of the actuators and of all transmissions.
    actuated: HashSet<String>,
    actuators: Taken,
    transmissions: Taken,
    /// The actuators, in their order.
    pub order: Vec<String>,
}

impl Kept {
    /// Transmissions of the joints that have none: each is driven directly. A joint without effort is not.
    pub fn others(&mut self, of: &Structure) -> Vec<Element> {
        let mut others = Vec::new();
        for (index, joint) in of.view.joints.iter().enumerate() {
            if is_weak(joint) || !of.is_driven(index) || self.actuated.contains(&joint.name) {
                continue;
            }
            let name = self.actuators.free(joint.name.clone());
            let transmission = self.transmissions.free(format!("{name}_transmission"));
            self.order.push(name.clone());
            others.push(
                Element::new("transmission")
                    .with("name", transmission)
                    .holding(Element::text("type", "transmission_interface/SimpleTransmission"))
                    .holding(Element::new("joint").with("name", joint.name.as_str()))
                    .holding(Element::new("actuator").with("name", name)),
            );
        }
        others
    }
}

/// Whether a joint is without effort: Drake drops its actuator.
pub(super) fn is_weak(joint: &View) -> bool {
    joint.limit.and_then(|limit| limit.effort) == Some(0.0)
}

pub(super) fn kept(texts: &[String], driven: &Driven, notes: &mut Vec<Note>) -> Kept {
    let [mut actuators, mut actuated, mut transmissions] =
        [HashSet::new(), HashSet::new(), HashSet::new()];
    let mut order = Vec::new();
    let mut is_kept = |text: &String| {
        let Ok(document) = urdd_xml::parse(text, Kind::Other) else { return true };
        let root = document.root_element();
        let (element, reason) = match root.tag_name().name() {
            "transmission" => {
                transmissions.extend(root.attribute("name").map(str::to_owned));
                let refused = refused(root, driven, (&mut actuators, &mut order), &mut actuated);
                ("transmission", refused)
            }
            "loop_joint" => ("loop_joint", Some("Drake has no loops in a URDF")),
            "frame" => ("frame", Some("Drake would take it for one of its own")),
            _ => return true,
        };
        notes.extend(reason.map(|reason| Note::Element { element, reason }));
        reason.is_none()
    };
    let texts = texts.iter().filter(|text| is_kept(text)).cloned().collect();
    let [actuators, transmissions] = [&actuators, &transmissions].map(Taken::new);
    Kept { texts, actuated, actuators, transmissions, order }
}

/// Why Drake rejects a transmission.
fn refused(
    transmission: Node,
    driven: &Driven,
    (actuators, order): (&mut HashSet<String>, &mut Vec<String>),
    actuated: &mut HashSet<String>,
) -> Option<&'static str> {
    let child = |name: &str| {
        let mut children = transmission.children();
        children.find(|child| child.has_tag_name(name))
    };
    let of_child = |name: &str| child(name).and_then(|child| child.attribute("name"));
    let kind = match child("type") {
        Some(kind) => kind.text().map(str::trim),
        None => transmission.attribute("type"),
    };
    match kind {
        None | Some("") => return Some("it has no type"),
        // Drake ignores other types.
        Some(kind) if !kind.contains("SimpleTransmission") => return None,
        Some(_) => {}
    }
    let Some(actuator) = of_child("actuator") else { return Some("it names no actuator") };
    let Some(joint) = of_child("joint") else { return Some("it names no joint") };
    let is = |names: &[String]| names.iter().any(|name| name == joint);
    if is(&driven.fixed) {
        return None;
    }
    if !is(&driven.of_one) {
        return Some("its joint does not exist, or has several DOFs");
    }
    if actuators.insert(actuator.to_owned()) {
        order.push(actuator.to_owned());
        actuated.insert(joint.to_owned());
        None
    } else {
        Some("another transmission has the same actuator")
    }
}
