//! Finds the names of links, joints, materials and meshes in a URDF, both in its own elements and in those that it does
//! not define.

use std::collections::{BTreeMap, BTreeSet};

use urdd_xml::{Document, Node};

use urdd_format::urdf::UrdfModule;
use urdd_xml::element::{Edit, attribute, children, name};

/// Attributes of elements unknown to URDF whose value, if it equals a link or joint name, refers to it.
const ATTRIBUTES: &[&str] =
    &["link", "link1", "link2", "joint", "joint1", "joint2", "reference", "mimic_joint"];

/// Elements unknown to URDF whose text, if it equals a link or joint name, refers to it.
const TEXTS: &[&str] = &[
    "bodyName",
    "body_name",
    "frameName",
    "frame_name",
    "frame_id",
    "jointName",
    "joint_name",
    "linkName",
    "link_name",
    "left_joint",
    "right_joint",
    "leftJoint",
    "rightJoint",
    "robotBaseFrame",
    "robot_base_frame",
];

/// Elements unknown to URDF whose `name`, if it equals a joint name, refers to that joint.
const OF_JOINTS: &[&str] = &[
    "joint",
    "flexJoint",
    "rollJoint",
    "gap_joint",
    "passive_joint",
    "simulated_actuated_joint",
    "use_simulated_gripper_joint",
];

/// Elements unknown to URDF whose `name` is their own and must be unique among the parts.
const OWN: &[&str] = &[
    "transmission",
    "actuator",
    "leftActuator",
    "rightActuator",
    "ros2_control",
    "gpio",
    "sensor",
    // Of URDF+.
    "loop",
    "coupling",
];

/// The kind of thing that a name refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Named {
    Link,
    Joint,
    Material,
    /// A link or joint with this name.
    Either,
    Own,
}

/// An occurrence of a name in a URDF's text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct NamePlace {
    /// The name, without entities and white space.
    pub name: String,
    pub named: Named,
    /// The byte range of the attribute's value or of the element's text.
    pub range: std::ops::Range<usize>,
    /// The child element of `<robot>` that contains it.
    pub top: std::ops::Range<usize>,
    /// The innermost element to remove if the named link or joint is dropped: a joint of `ros2_control`, a whole
    /// transmission.
    pub unit: std::ops::Range<usize>,
    /// Whether it is in an element that URDF does not define.
    pub unknown: bool,
}

/// A value that equals the name of a link or joint but may mean something else.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LeftAlone {
    /// `element`, or `element@attribute`.
    pub place: String,
    pub name: String,
}

#[derive(Debug, Default)]
pub(super) struct Names {
    pub places: Vec<NamePlace>,
    pub left_alone: BTreeSet<LeftAlone>,
}

/// Finds the names in a URDF. `more` lists further places of link and joint names in elements that URDF does not
/// define: `element` or `element@attribute`.
pub(super) fn find(document: &Document, robot: &UrdfModule, more: &BTreeSet<&str>) -> Names {
    let mut finder = Finder {
        links: robot.links.iter().map(|link| link.name.as_str()).collect(),
        joints: robot.joints.iter().map(|joint| joint.name.as_str()).collect(),
        more,
        found: Names::default(),
        top: 0..0,
    };
    for (tag, element) in children(document.root_element()) {
        finder.top = element.range();
        match tag {
            "link" => finder.link(element),
            "joint" => finder.joint(element),
            "material" => finder.attribute(element, "name", Named::Material),
            _ => finder.unknown(element, element.range()),
        }
    }
    finder.found
}

struct Finder<'a> {
    links: BTreeSet<&'a str>,
    joints: BTreeSet<&'a str>,
    more: &'a BTreeSet<&'a str>,
    found: Names,
    top: std::ops::Range<usize>,
}

impl Finder<'_> {
    fn push(&mut self, text: &str, named: Named, range: std::ops::Range<usize>, unit: Node) {
        self.found.places.push(NamePlace {
            name: text.to_owned(),
            named,
            range,
            top: self.top.clone(),
            unit: unit.range(),
            unknown: false,
        });
    }

    fn attribute<'a>(&mut self, element: Node<'a, 'a>, key: &str, named: Named) {
        // Some programs write an empty name for a missing one.
        if let Some(found) = attribute(element, key).filter(|found| !found.value().is_empty()) {
            self.push(found.value(), named, found.range_value(), element);
        }
    }

    fn link<'a>(&mut self, link: Node<'a, 'a>) {
        self.attribute(link, "name", Named::Link);
        for (tag, element) in children(link) {
            match tag {
                "visual" => {
                    for (tag, inner) in children(element) {
                        if tag == "material" {
                            self.attribute(inner, "name", Named::Material);
                        }
                    }
                }
                "inertial" | "collision" => {}
                _ => self.unknown(element, element.range()),
            }
        }
    }

    fn joint<'a>(&mut self, joint: Node<'a, 'a>) {
        self.attribute(joint, "name", Named::Joint);
        for (tag, element) in children(joint) {
            match tag {
                "parent" | "child" => self.attribute(element, "link", Named::Link),
                "mimic" => self.attribute(element, "joint", Named::Joint),
                "origin" | "axis" | "limit" | "dynamics" | "safety_controller" | "calibration" => {}
                _ => self.unknown(element, element.range()),
            }
        }
    }

    fn named(&self, text: &str) -> Option<Named> {
        match (self.links.contains(text), self.joints.contains(text)) {
            (true, true) => Some(Named::Either),
            (true, false) => Some(Named::Link),
            (false, true) => Some(Named::Joint),
            (false, false) => None,
        }
    }

    /// Searches an element that URDF does not define. `unit` is what to remove with a dropped name.
    fn unknown<'a>(&mut self, element: Node<'a, 'a>, unit: std::ops::Range<usize>) {
        let tag = name(element);
        let begins = self.found.places.len();
        for found in element.attributes() {
            let (key, value) = (found.name(), found.value());
            let place = format!("{tag}@{key}");
            let is_name = key == "name";
            let is_own = is_name && OWN.contains(&tag);
            let is_known = self.more.contains(place.as_str())
                || ATTRIBUTES.contains(&key)
                || (matches!(key, "parent" | "child") && self.links.contains(value))
                || (is_name && OF_JOINTS.contains(&tag) && self.joints.contains(value));
            let named = match self.named(value) {
                Some(named) if is_known => named,
                _ if is_own => Named::Own,
                Some(_) => {
                    self.found.left_alone.insert(LeftAlone { place, name: value.to_owned() });
                    continue;
                }
                None => continue,
            };
            self.push(value, named, found.range_value(), element);
        }
        let mut texts = element.children().filter(Node::is_text);
        if let (Some(text), None) = (texts.next(), texts.next()) {
            self.text(element, tag, text);
        }
        for place in &mut self.found.places[begins..] {
            place.unit = unit.clone();
            place.unknown = true;
        }
        for (inner_tag, inner) in children(element) {
            // In ros2_control only the joint is removed; a transmission is removed as a whole.
            let is_own_unit = tag == "ros2_control";
            let unit = match is_own_unit && matches!(inner_tag, "joint" | "sensor" | "gpio") {
                true => inner.range(),
                false => unit.clone(),
            };
            self.unknown(inner, unit);
        }
    }

    fn text<'a>(&mut self, element: Node<'a, 'a>, tag: &str, text: Node<'a, 'a>) {
        let value = text.text().unwrap_or_default().trim();
        let Some(named) = self.named(value) else { return };
        let is_mimic_param = tag == "param"
            && attribute(element, "name").is_some_and(|name| name.value() == "mimic");
        let is_known = TEXTS.contains(&tag) || self.more.contains(tag) || is_mimic_param;
        if is_known {
            self.push(value, named, text.range(), element);
        } else {
            let place = tag.to_owned();
            self.found.left_alone.insert(LeftAlone { place, name: value.to_owned() });
        }
    }
}

pub(super) fn mesh_edits(document: &Document, names: &BTreeMap<String, String>) -> Vec<Edit> {
    let mut edits = Vec::new();
    for (_, link) in children(document.root_element()).filter(|(tag, _)| *tag == "link") {
        let shapes = children(link).filter(|(tag, _)| matches!(*tag, "visual" | "collision"));
        let geometries =
            shapes.flat_map(|(_, shape)| children(shape)).filter(|(tag, _)| *tag == "geometry");
        let meshes = geometries.flat_map(|(_, geometry)| children(geometry));
        for (_, mesh) in meshes.filter(|(tag, _)| *tag == "mesh") {
            let Some(filename) = attribute(mesh, "filename") else { continue };
            if let Some(new) = names.get(filename.value()) {
                edits.push(Edit { range: filename.range_value(), text: escaped(new) });
            }
        }
    }
    edits
}

pub(super) fn escaped(text: &str) -> String {
    urdd_xml::escape(text).into_owned()
}
