//! Kinematic loops as joints whose child has a parent already.
//!
//! A joint of SDF has one frame: in its child by its pose, and in its parent where that frame is in the pose of the file, in
//! which all joints are at 0. A loop that is open there cannot be said.

use nalgebra::{Isometry3, Vector3};

use super::joints::placed;
use crate::joints::moved;
use crate::loops::{Closing, LeftOut, OTHER_KIND, closings};
use crate::{ExportError, Note, Subject, Taken};
use urdd_format::loops::LoopKind;
use urdd_format::readable::number;
use urdd_kinematics::loops::Gap;
use urdd_xml::number::numbers;
use urdd_xml::writer::Element;

/// A loop that is open by no more than its tolerance and this is closed, m and rad.
const CLOSED: f64 = 1e-6;

/// What is shown of how far a loop is open, m and rad.
const ROUNDING: f64 = 1e-9;

const LOOPS: &str = "joints that close loops are joints whose child has a parent already: Gazebo Classic holds them, DART in Gazebo leaves them out with a message (gz-physics of 2026-08), and Drake refuses the file: for Drake, export `drake`";

/// The joints that close loops.
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
    let shown = |gap: f64| number((gap / ROUNDING).round() * ROUNDING, 3);
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
