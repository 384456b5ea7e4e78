//! Transmissions and loops that Drake's URDF parser accepts.

use std::collections::HashSet;

use roxmltree::Node;

use super::super::error::Note;
use super::joints::Driven;
use urdd_xml::Kind;

/// Elements directly under `robot`, without those that Drake rejects.
pub(super) fn taken(texts: &[String], driven: &Driven, notes: &mut Vec<Note>) -> Vec<String> {
    let mut actuators = HashSet::new();
    let mut is_taken = |text: &String| {
        let Ok(document) = urdd_xml::parse(text, Kind::Other) else {
            return true;
        };
        let root = document.root_element();
        let (element, reason) = match root.tag_name().name() {
            "transmission" => ("transmission", refused(root, driven, &mut actuators)),
            "loop_joint" => ("loop_joint", Some("Drake has no loops in a URDF")),
            "frame" => ("frame", Some("Drake would take it for one of its own")),
            _ => return true,
        };
        notes.extend(reason.map(|reason| Note::Element { element, reason }));
        reason.is_none()
    };
    texts
        .iter()
        .filter(|text| is_taken(text))
        .cloned()
        .collect()
}

/// Why Drake rejects a transmission.
fn refused(
    transmission: Node,
    driven: &Driven,
    actuators: &mut HashSet<String>,
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
    match actuators.insert(actuator.to_owned()) {
        true => None,
        false => Some("another transmission has the same actuator"),
    }
}
