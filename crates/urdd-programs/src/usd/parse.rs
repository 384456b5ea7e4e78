//! What the converter refuses while it goes through the elements, whatever they are for.

use std::borrow::Cow;

use crate::number::python;
use crate::prelude::*;

/// Elements in each other, at which Python's stack ends.
const MAX_DEPTH: usize = 993;

/// Lines that are XML declarations are left out, wherever they are; here they become spaces.
pub fn without_declarations(text: &str) -> Cow<'_, str> {
    let is_declaration = |line: &str| {
        let line = line.trim();
        line.starts_with("<?xml") && line.ends_with("?>")
    };
    let lines = || text.split_inclusive(['\n', '\r']);
    if !lines().any(is_declaration) {
        return text.into();
    }
    let blank = |line: &str| line.bytes().map(|_| ' ').collect::<String>();
    lines()
        .map(|line| if is_declaration(line) { blank(line).into() } else { Cow::Borrowed(line) })
        .collect::<String>()
        .into()
}

/// An element, and what is above it.
struct Place<'t> {
    node: Node<'t>,
    /// The name of the element above, if that is one of URDF.
    above: Option<&'t str>,
    depth: usize,
    /// Whether the attributes of elements in it that URDF does not have are kept.
    is_kept: bool,
}

pub fn elements(robot: Node<'_>, effects: &mut Effects) -> Reading<()> {
    let mut open = vec![Place { node: robot, above: Some(""), depth: 1, is_kept: true }];
    while let Some(place) = open.pop() {
        let node = place.node;
        if place.depth > MAX_DEPTH {
            return effects.refuse(node, Fault::Xml("elements are nested too deep"));
        }
        let parent = place.above.filter(|above| is_in(node.name(), above));
        let is_kept = match parent {
            Some(above) => match node.name() {
                "robot" | "link" | "joint" | "visual" | "collision" => true,
                "material" => above == "robot",
                _ => false,
            },
            None => place.is_kept,
        };
        let _ = element(node, parent, effects);
        if is_kept {
            names_of_attributes(node, effects);
        }
        let above = parent.map(|_| node.name());
        let below =
            node.children().map(|node| Place { node, above, depth: place.depth + 1, is_kept });
        let start = open.len();
        open.extend(below);
        open[start..].reverse();
    }
    Ok(())
}

/// Whether URDF has an element in another.
fn is_in(name: &str, above: &str) -> bool {
    match name {
        "robot" => above.is_empty(),
        "link" | "joint" => above == "robot",
        "material" => matches!(above, "robot" | "visual"),
        "inertial" | "visual" | "collision" => above == "link",
        "origin" => matches!(above, "inertial" | "visual" | "collision" | "joint"),
        "geometry" => matches!(above, "visual" | "collision"),
        "box" | "sphere" | "cylinder" | "mesh" => above == "geometry",
        "color" | "texture" => above == "material",
        "mass" | "inertia" => above == "inertial",
        "verbose" => above == "collision",
        "parent" | "child" | "axis" | "calibration" | "dynamics" | "limit"
        | "safety_controller" | "mimic" => above == "joint",
        _ => false,
    }
}

/// Refuses an element for its attributes. `above` is the element around one that URDF has there.
fn element(node: Node<'_>, above: Option<&str>, effects: &mut Effects) -> Reading<()> {
    let is_needed = |effects: &mut Effects, name: &'static str| match node.attribute(name) {
        None => effects.refuse(node, Fault::Missing(name)),
        Some(value) if value.value.is_empty() => effects.refuse(value, Fault::Empty(name)),
        Some(_) => Ok(()),
    };
    let kind = above.map(|above| (node.name(), above));
    if let Some(("robot" | "link" | "joint", _) | ("material", "robot")) = kind {
        is_needed(effects, "name")?;
    }
    if let Some(("joint", _)) = kind {
        is_needed(effects, "type")?;
        if let Some(kind) =
            node.attribute("type").filter(|kind| !JOINT_TYPES.contains(&&*kind.value))
        {
            return effects.refuse(kind, Fault::value("type", &kind.value));
        }
    }
    // These are numbers on any element.
    for name in ["size", "xyz", "rpy"] {
        vector(node.attribute(name), 3, effects)?;
    }
    scalars(node, &["radius", "length"], effects)?;
    let Some((name, _)) = kind else { return Ok(()) };
    let numbers: &[&str] = match name {
        "mass" => &["value"],
        "inertia" => &["ixx", "iyy", "izz", "ixy", "ixz", "iyz"],
        "mimic" => &["multiplier", "offset"],
        "limit" => &["lower", "upper", "effort", "velocity"],
        "calibration" => &["reference_position", "rising", "falling"],
        "dynamics" => &["damping", "friction"],
        "safety_controller" => {
            &["soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"]
        }
        _ => &[],
    };
    match name {
        "color" => vector(node.attribute("rgba"), 4, effects)?,
        "mesh" => vector(node.attribute("scale"), 3, effects)?,
        "mimic" if node.attribute("joint").is_none() => {
            return effects.refuse(node, Fault::Missing("joint"));
        }
        "parent" | "child" if node.attribute("link").is_none() => {
            return effects.refuse(node, Fault::Missing("link"));
        }
        "joint" => axes(node, effects),
        _ => {}
    }
    scalars(node, numbers, effects)
}

/// An axis of length 0 is refused, but of a fixed joint.
fn axes(joint: Node<'_>, effects: &mut Effects) {
    let axes = joint.named("axis").filter_map(|axis| axis.attribute("xyz"));
    for xyz in axes.filter(|_| joint.value("type") != Some("fixed")) {
        let numbers = xyz.value.split_whitespace().map(python);
        if numbers.fold(0, |zeros, number| zeros + usize::from(number == Some(0.0))) == 3 {
            effects.refuse_mendable(xyz, Fault::range(xyz, "an axis has no length 0"));
        }
    }
}

fn scalars(node: Node<'_>, names: &[&str], effects: &mut Effects) -> Reading<()> {
    for value in names.iter().filter_map(|name| node.attribute(name)) {
        if python(&value.value).is_none() {
            return effects.refuse(value, Fault::not_a_number(value));
        }
    }
    Ok(())
}

fn vector(value: Option<&Attribute<'_>>, count: usize, effects: &mut Effects) -> Reading<()> {
    let Some(value) = value else { return Ok(()) };
    let mut found = 0;
    let mut are_numbers = true;
    for piece in value.value.split_whitespace() {
        found += 1;
        are_numbers &= python(piece).is_some();
    }
    match are_numbers {
        _ if found != count => effects.refuse(value, Fault::count(value, count)),
        false => effects.refuse(value, Fault::not_a_number(value)),
        true => Ok(()),
    }
}

/// Attributes that URDF does not have become attributes of USD, which have no such names.
fn names_of_attributes(node: Node<'_>, effects: &mut Effects) {
    for attribute in node.attributes() {
        if attribute.name.contains(['-', '.', '{']) {
            let name = attribute.name.rsplit('}').next().unwrap_or_default().into();
            let kind = match attribute.name.contains('{') {
                true => "attribute with a prefix",
                false => "attribute",
            };
            let rule = "in USD no attribute has a `-`, a `.` or a prefix in its name";
            effects.refuse_mendable(attribute, Fault::Name { kind, name, rule });
        }
    }
}
