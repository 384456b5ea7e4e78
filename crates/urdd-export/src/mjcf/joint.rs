//! Joints of a body.

use nalgebra::Vector3;

use super::super::element::Element;
use super::super::error::Note;
use super::super::numbers::{number, numbers};
use urdd_document::robot::Joint;
use urdd_format::urdf::{Joint as Source, JointType};
use urdd_kinematics::rotation::{planar_basis, unit_axis};

const CROSSED: &str =
    "its lower limit is not below its upper one, which MuJoCo refuses; it has no range";

/// The MJCF joints that together represent a URDF joint, in the order in which MuJoCo applies them.
pub(super) fn joints(joint: &Joint, source: &Source, notes: &mut Vec<Note>) -> Vec<Element> {
    let name = joint.name.as_str();
    let slide = |coordinate: &str, axis: Vector3<f64>| {
        Element::new("joint")
            .with("name", format!("{name}/{coordinate}"))
            .with("type", "slide")
            .with("axis", numbers(axis.as_slice()))
    };
    let ball = || {
        Element::new("joint")
            .with("name", name)
            .with("type", "ball")
    };
    match joint.joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Revolute | JointType::Continuous => vec![of_one(joint, source, "hinge", notes)],
        JointType::Prismatic => vec![of_one(joint, source, "slide", notes)],
        JointType::Spherical => vec![ball()],
        JointType::Floating => vec![
            slide("trans_x", Vector3::x()),
            slide("trans_y", Vector3::y()),
            slide("trans_z", Vector3::z()),
            ball(),
        ],
        JointType::Planar => {
            let axis = unit_axis(joint.axis).unwrap_or(Vector3::x_axis());
            let [x, y] = planar_basis(&axis);
            let hinge = Element::new("joint")
                .with("name", format!("{name}/rot"))
                .with("type", "hinge")
                .with("axis", numbers(axis.as_slice()));
            vec![slide("trans_x", x), slide("trans_y", y), hinge]
        }
    }
}

/// The names of the MJCF joints that represent a URDF joint.
pub(super) fn names(joint: &Joint) -> Vec<String> {
    let name = joint.name.as_str();
    let part = |part: &str| format!("{name}/{part}");
    match joint.joint_type {
        JointType::Fixed => Vec::new(),
        JointType::Floating => vec![
            part("trans_x"),
            part("trans_y"),
            part("trans_z"),
            name.to_owned(),
        ],
        JointType::Planar => vec![part("trans_x"), part("trans_y"), part("rot")],
        _ => vec![name.to_owned()],
    }
}

fn of_one(joint: &Joint, source: &Source, kind: &'static str, notes: &mut Vec<Note>) -> Element {
    let mut element = Element::new("joint")
        .with("name", joint.name.as_str())
        .with("type", kind)
        .with("axis", numbers(&joint.axis));
    match joint.position_limits() {
        Some((lower, upper)) if lower < upper => {
            element = element.with("range", numbers(&[lower, upper]));
        }
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
