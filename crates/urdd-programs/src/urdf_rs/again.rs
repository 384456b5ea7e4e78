//! What xml-rs refuses, by which urdf-rs reads again what RustyXML kept.

use crate::effect::{Effects, Reading};
use crate::fault::Fault;
use crate::tree::Node;

/// All that was kept of a robot.
pub(super) fn check(robot: Node<'_>, effects: &mut Effects) -> Reading<()> {
    let mut open = Vec::new();
    tag(robot, effects)?;
    for part in robot.children() {
        match part.name() {
            "link" => {
                tag(part, effects)?;
                let kept = ["visual", "inertial", "collision"];
                open.extend(part.children().filter(|node| kept.contains(&node.name())));
            }
            "joint" | "material" => open.push(part),
            _ => {}
        }
    }
    while let Some(node) = open.pop() {
        tag(node, effects)?;
        if node.text().is_some_and(|text| !text.chars().all(is_character)) {
            return effects.refuse(node, Fault::Xml("text has a control character"));
        }
        open.extend(node.children());
    }
    Ok(())
}

fn tag(node: Node<'_>, effects: &mut Effects) -> Reading<()> {
    if !is_name(node.name()) {
        return effects.refuse(node, Fault::Xml("`<` is not followed by a name"));
    }
    for attribute in node.attributes() {
        if !is_name(&attribute.name) {
            return effects
                .refuse(attribute, Fault::Xml("a tag has something that is no attribute"));
        }
        if !attribute.value.chars().all(is_character) {
            return effects.refuse(attribute, Fault::Xml("text has a control character"));
        }
    }
    Ok(())
}

/// A name without a prefix, as XML has it.
fn is_name(name: &str) -> bool {
    let is_start = |one: char| {
        one.is_ascii_alphabetic() || one == '_' || !one.is_ascii() && !one.is_whitespace()
    };
    let is_inside = |one: char| is_start(one) || one.is_ascii_digit() || matches!(one, '-' | '.');
    name.starts_with(is_start) && name.chars().all(is_inside)
}

/// A character that XML 1.0 allows.
fn is_character(one: char) -> bool {
    matches!(one, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..)
}
