//! Joints of a body.

use crate::{Moves, Note, Subject};
use urdd_document::robot::Joint;
use urdd_format::urdf::{Joint as Source, JointType};
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

const LOCKED: &str = "its limits are equal, which MuJoCo refuses; an equality constraint holds it there, and it has no actuator";

const CROSSED: &str =
    "its lower limit is not below its upper one, which MuJoCo refuses; it has no range";

/// The MJCF joints that together represent a URDF joint, in the order in which MuJoCo applies them.
pub(super) fn joints(subject: &Subject, index: usize, notes: &mut Vec<Note>) -> Vec<Element> {
    let (joint, source) = (&subject.view.joints[index], &subject.urdf.joints[index]);
    let of_one = |kind, notes| {
        // The inertia of the motor, kg m² or kg.
        let armature = subject.gains(index).armature;
        let is_locked = subject.locked_at(index).is_some();
        let element = of_one(joint, source, is_locked, kind, notes);
        vec![element.with_some("armature", armature.map(number))]
    };
    match joint.joint_type {
        JointType::Revolute | JointType::Continuous => of_one("hinge", notes),
        JointType::Prismatic => of_one("slide", notes),
        _ => subject.names.parts[index].iter().map(of_part).collect(),
    }
}

fn of_part((name, moves): &(String, Moves)) -> Element {
    let (kind, axis) = match moves {
        Moves::Slides(axis) => ("slide", Some(axis)),
        Moves::Turns(axis) => ("hinge", Some(axis)),
        Moves::Ball => ("ball", None),
    };
    Element::new("joint")
        .with("name", name.as_str())
        .with("type", kind)
        .with_some("axis", axis.map(|axis| numbers(axis.as_slice())))
}

fn of_one(
    joint: &Joint,
    source: &Source,
    is_locked: bool,
    kind: &'static str,
    notes: &mut Vec<Note>,
) -> Element {
    let mut element = Element::new("joint")
        .with("name", joint.name.as_str())
        .with("type", kind)
        .with("axis", numbers(&joint.axis));
    match joint.position_limits() {
        Some((lower, upper)) if lower < upper => {
            element = element.with("range", numbers(&[lower, upper]));
        }
        Some(_) if is_locked => notes.push(Note::joint(&joint.name, LOCKED)),
        Some(_) => notes.push(Note::joint(&joint.name, CROSSED)),
        None => {}
    }
    if let Some(effort) = joint.limit.and_then(|limit| limit.effort)
        && effort > 0.0
    {
        element = element.with("actuatorfrcrange", numbers(&[-effort, effort]));
    }
    let dynamics = source.dynamics.as_ref();
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0).map(number);
    element
        .with_some("damping", positive(dynamics.and_then(|d| d.damping)))
        .with_some("frictionloss", positive(dynamics.and_then(|d| d.friction)))
}
