//! Transmissions and loops that Drake's URDF parser accepts.

use std::collections::HashSet;

use urdd_xml::{Kind, Node};

use super::joints::Driven;
use crate::{Note, Structure, Taken};
use urdd_document::robot::Joint;
use urdd_xml::writer::Element;

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
pub(super) fn is_weak(joint: &Joint) -> bool {
    joint.limit.and_then(|limit| limit.effort) == Some(0.0)
}

pub(super) fn kept(texts: &[String], driven: &Driven, notes: &mut Vec<Note>) -> Kept {
    let [mut actuators, mut actuated, mut transmissions] =
        [HashSet::new(), HashSet::new(), HashSet::new()];
    let mut order = Vec::new();
    let mut is_kept = |text: &String| {
        let Ok(document) = urdd_xml::parse(text, Kind::Other) else {
            return true;
        };
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
    let Some(actuator) = of_child("actuator") else {
        return Some("it names no actuator");
    };
    let Some(joint) = of_child("joint") else {
        return Some("it names no joint");
    };
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
