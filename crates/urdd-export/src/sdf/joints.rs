//! Joints: each as SDF's, or as a chain of them; and kinematic loops as joints whose child has a parent already.
//!
//! A joint of SDF has one frame: in its child by its pose, and in its parent where that frame is in the pose of the file, in
//! which all joints are at 0. A loop that is open there cannot be said.

use std::collections::HashMap;

use nalgebra::{Isometry3, Vector3};

use super::gazebo::{Gazebo, Place};
use crate::joints::{Closing, LeftOut, OTHER_KIND, closings, coupled, moved, range};
use crate::{ExportError, Moves, Note, Subject, Taken};
use urdd_document::robot::Joint as View;
use urdd_format::loops::LoopKind;
use urdd_format::readable;
use urdd_format::urdf::{Joint, JointType};
use urdd_kinematics::loops::Gap;
use urdd_kinematics::rotation::{to_rpy, unit_axis};
use urdd_xml::number::{number, numbers};
use urdd_xml::writer::Element;

const CHAIN: &str =
    "it has several DOFs; it is a chain of simple joints with light links between them";
const CROSSED: &str = "its lower limit is above its upper one, which SDF refuses; it has no range";
const AXIS: &str = "its axis is zero, which SDF refuses; it is fixed";

#[derive(Default)]
pub(super) struct Joints {
    pub elements: Vec<Element>,
    /// All names of the model so far.
    pub taken: Taken,
    /// For each joint of the robot, the joint of SDF that moves its child.
    pub last_parts: Vec<String>,
    /// The links between the parts of a joint, each with the joint of SDF that moves it.
    pub links: Vec<(String, String)>,
    pub has_mimics: bool,
}

pub(super) fn joints(
    subject: &Subject,
    taken: Taken,
    gazebo: &Gazebo,
    notes: &mut Vec<Note>,
) -> Result<Joints, ExportError> {
    let names = &subject.names;
    let mut made = Joints { taken, ..Joints::default() };
    let by_name: HashMap<&str, &String> =
        subject.view.joints.iter().map(|joint| joint.name.as_str()).zip(&names.joints).collect();
    let each = coupled(subject, notes)?.into_iter().zip(&subject.view.joints).enumerate();
    for (index, (mut joint, view)) in each {
        if subject.is_of_frame(index) {
            made.last_parts.push(String::new());
            continue;
        }
        if let Some(mimic) = &mut joint.mimic
            && let Some(driver) = by_name.get(mimic.joint.as_str())
        {
            mimic.joint.clone_from(driver);
        }
        let own = &names.joints[index];
        if *own != view.name {
            notes.push(Note::Renamed { joint: view.name.clone(), name: own.clone() });
        }
        let parts = parts(&joint, view, own, &names.parts[index]);
        if parts.len() > 1 {
            notes.push(Note::joint(&view.name, CHAIN));
        }
        let mut parent = view.parent.clone();
        let last = parts.len() - 1;
        for (place, part) in parts.into_iter().enumerate() {
            let child = if place == last {
                view.child.clone()
            } else {
                made.taken.free(format!("{}_link", part.name))
            };
            let mut element =
                Element::new("joint").with("name", part.name.as_str()).with("type", part.kind);
            let pose = match place {
                0 => numbers(&pose(&joint, view)),
                _ => "0 0 0 0 0 0".to_owned(),
            };
            // SDF's own `world` is outside of the model.
            let is_world = parent == "world";
            let frame = if is_world { "__model__" } else { parent.as_str() };
            let frame = Element::new("pose").with("relative_to", frame);
            element.push(frame.containing(&pose));
            element.push(Element::text("parent", &parent));
            element.push(Element::text("child", &child));
            if let Some(axis) = part.axis {
                let mut axis =
                    Element::new("axis").holding(Element::text("xyz", &numbers(axis.as_slice())));
                if part.is_own {
                    fill(&mut axis, &joint, view, notes, &mut made.has_mimics);
                }
                element.push(axis);
            }
            if place == last {
                let names = &mut Taken::default();
                gazebo.add(&view.name, Place::Joint, &mut element, names, notes);
            }
            made.elements.push(element);
            if place == last {
                made.last_parts.push(part.name.clone())
            } else {
                made.links.push((child.clone(), part.name.clone()))
            }
            parent = child;
        }
        if joint.joint_type != JointType::Fixed
            && view.num_dofs() == 1
            && unit_axis(view.axis).is_none()
        {
            notes.push(Note::joint(&view.name, AXIS));
        }
    }
    Ok(made)
}

pub(super) fn placed(pose: &Isometry3<f64>) -> Element {
    let rotation = pose.rotation.to_rotation_matrix();
    let mut values = pose.translation.vector.as_slice().to_vec();
    values.extend(to_rpy(rotation.matrix()));
    Element::text("pose", &numbers(&values))
}

/// Position and roll, pitch, yaw of a joint in its parent link. A joint that follows a fixed one stands at its offset.
fn pose(joint: &Joint, view: &View) -> [f64; 6] {
    let (xyz, rpy) = match &joint.origin {
        Some(origin) if joint.joint_type != view.joint_type => {
            (origin.xyz.unwrap_or_default(), origin.rpy.unwrap_or_default())
        }
        _ => (view.origin.xyz, to_rpy(&view.origin.rotation())),
    };
    let ([x, y, z], [roll, pitch, yaw]) = (xyz, rpy);
    [x, y, z, roll, pitch, yaw]
}

struct Part {
    name: String,
    kind: &'static str,
    axis: Option<Vector3<f64>>,
    /// Whether limits, dynamics and mimic of the source are its own.
    is_own: bool,
}

/// The joints of SDF that together are a joint, from its parent to its child; at least one.
fn parts(joint: &Joint, view: &View, own: &str, chain: &[(String, Moves)]) -> Vec<Part> {
    let simple = |kind: &'static str, axis: Option<Vector3<f64>>| {
        vec![Part {
            name: own.to_owned(),
            kind: if axis.is_some() { kind } else { "fixed" },
            axis,
            is_own: true,
        }]
    };
    let axis = unit_axis(view.axis).map(|axis| axis.into_inner());
    let of_several = |(name, moves): &(String, Moves)| {
        let (kind, axis) = match *moves {
            Moves::Slides(axis) => ("prismatic", Some(axis)),
            Moves::Turns(axis) => ("continuous", Some(axis)),
            Moves::Ball => ("ball", None),
        };
        Part { name: name.clone(), kind, axis, is_own: false }
    };
    match joint.joint_type {
        JointType::Fixed => simple("fixed", None),
        JointType::Revolute => simple("revolute", axis),
        JointType::Continuous => simple("continuous", axis),
        JointType::Prismatic => simple("prismatic", axis),
        JointType::Spherical | JointType::Floating | JointType::Planar => {
            chain.iter().map(of_several).collect()
        }
    }
}

/// Limits, dynamics and the mimic of a joint of one DOF.
fn fill(
    axis: &mut Element,
    joint: &Joint,
    view: &View,
    notes: &mut Vec<Note>,
    has_mimics: &mut bool,
) {
    let text = |name: &'static str, value: f64| Element::text(name, &number(value));
    let positive = |(name, value): (&'static str, Option<f64>)| {
        value.filter(|value| *value >= 0.0).map(|value| text(name, value))
    };
    let mut limit = Element::new("limit");
    if let Some((lower, upper)) = range(view, CROSSED, notes) {
        limit.push(text("lower", lower));
        limit.push(text("upper", upper));
    }
    let each = joint.limit.as_ref().map(|of| [("effort", of.effort), ("velocity", of.velocity)]);
    limit.extend(each.into_iter().flatten().filter_map(positive));
    axis.push_filled(limit);
    if let Some(of) = &joint.dynamics {
        let mut dynamics = Element::new("dynamics");
        let each = [("damping", of.damping), ("friction", of.friction)];
        dynamics.extend(each.into_iter().filter_map(positive));
        axis.push_filled(dynamics);
    }
    if let Some(mimic) = &joint.mimic {
        *has_mimics = true;
        axis.push(
            Element::new("mimic")
                .with("joint", mimic.joint.as_str())
                .holding(text("multiplier", mimic.multiplier.unwrap_or(1.0)))
                .holding(text("offset", mimic.offset.unwrap_or(0.0)))
                .holding(text("reference", 0.0)),
        );
    }
}

/// A loop that is open by no more than its tolerance and this is closed, m and rad.
const CLOSED: f64 = 1e-6;

/// What is shown of how far a loop is open, m and rad.
const ROUNDING: f64 = 1e-9;

const LOOPS: &str = "joints that close loops are joints whose child has a parent already: Gazebo Classic holds them, DART in Gazebo leaves them out with a message (gz-physics of 2026-08), and Drake refuses the file: for Drake, export `drake`";

pub(super) fn loops(
    subject: &Subject,
    taken: &mut Taken,
    notes: &mut Vec<Note>,
) -> Result<Vec<Element>, ExportError> {
    let mut left_out = LeftOut::default();
    let mut made = Vec::new();
    let poses = poses(subject);
    let mut open = Vec::new();
    let mut widest = Gap::default();
    for closing in closings(subject, &mut left_out)? {
        // The root has no parent, and the world is none's child.
        let is_turned = closing.ends[1].link == subject.tree.root;
        let [a, b] = closing.ends.map(|end| poses[end.link] * end.pose);
        let between = a.inv_mul(&b);
        let gap = Gap::of(closing.of.kind, &between);
        if gap.position > closing.of.position_tolerance + CLOSED
            || gap.rotation > closing.of.rotation_tolerance + CLOSED
        {
            widest.position = widest.position.max(gap.position);
            widest.rotation = widest.rotation.max(gap.rotation);
            open.push(closing.of.name.as_str());
            continue;
        }
        match joint(subject, &closing, &between, is_turned, taken) {
            Some(joint) => made.push(joint),
            None => left_out.of_loop(&closing.of.name, OTHER_KIND),
        }
    }
    let shown = |gap: f64| readable::number((gap / ROUNDING).round() * ROUNDING, 3);
    let [position, rotation] = [widest.position, widest.rotation].map(shown);
    let why = format!(
        "an SDF says where the ends of a joint are by its pose, in which all joints are at 0; there these are up to {position} m and {rotation} rad apart"
    );
    open.into_iter().for_each(|name| left_out.of_loop(name, why.as_str()));
    notes.extend(left_out.notes());
    if !made.is_empty() {
        notes.push(Note::Robot(LOOPS));
    }
    Ok(made)
}

/// The poses of links in the root where all joints are at 0, as the file has them.
fn poses(subject: &Subject) -> Vec<Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); subject.links.len()];
    for &link in &subject.tree.order {
        let Some((joint, parent)) =
            subject.tree.parent_joint[link].zip(subject.tree.parent_link[link])
        else {
            continue;
        };
        let view = &subject.view.joints[joint];
        let stands = subject.mimics.by_joint[joint].filter(|_| subject.follows_fixed(joint));
        let own = stands.map_or_else(Isometry3::identity, |of| moved(view, of.offset));
        poses[link] = poses[parent] * view.origin.motion() * own;
    }
    poses
}

/// The joint of a loop whose second frame is at `between` in its first; `None` for a kind that SDF does not have.
fn joint(
    subject: &Subject,
    closing: &Closing,
    between: &Isometry3<f64>,
    is_turned: bool,
    taken: &mut Taken,
) -> Option<Element> {
    let kind = match closing.of.kind {
        LoopKind::Fixed => "fixed",
        LoopKind::Revolute => "continuous",
        LoopKind::Prismatic => "prismatic",
        LoopKind::Spherical => "ball",
        LoopKind::Universal => "universal",
        LoopKind::Cylindrical | LoopKind::Planar => return None,
    };
    let [mut parent, mut child] = closing.ends;
    let mut other = between.rotation.inverse() * Vector3::z();
    if is_turned {
        std::mem::swap(&mut parent, &mut child);
        other = between.rotation * Vector3::z();
    }
    let link = |link: usize| subject.links[link].as_str();
    let mut joint =
        Element::new("joint").with("name", taken.free(closing.name.clone())).with("type", kind);
    joint.push(placed(&child.pose));
    joint.push(Element::text("parent", link(parent.link)));
    joint.push(Element::text("child", link(child.link)));
    let axis = |tag: &'static str, axis: Vector3<f64>| {
        Element::new(tag).holding(Element::text("xyz", &numbers(axis.as_slice())))
    };
    match closing.of.kind {
        LoopKind::Revolute | LoopKind::Prismatic => joint.push(axis("axis", Vector3::z())),
        LoopKind::Universal => {
            // Exactly at a right angle, as it is within rounding.
            other.z = 0.0;
            joint.push(axis("axis", other.normalize()));
            joint.push(axis("axis2", Vector3::z()));
        }
        _ => {}
    }
    Some(joint)
}
