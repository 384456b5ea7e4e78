//! urdf-rs 0.10.0: `read_file`. It reads structures, and looks at neither the tree nor, below URDF 1.2, what numbers
//! mean. An element may stand for an attribute of its name.

use crate::effect::{At, Effects, Reading};
use crate::fault::{Fault, shortened};
use crate::file::File;
use crate::tree::{Attribute, Node};
use crate::{rustyxml, tinyxml};

pub(crate) fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let text = std::str::from_utf8(file.bytes)
        .or_else(|bad| effects.refuse(bad.valid_up_to(), Fault::Xml("the file is not UTF-8")))?;
    let tree = rustyxml::parse(text).or_else(|bad| effects.refuse(bad.at, Fault::Xml(bad.why)))?;
    let Some(robot) = tree.tops().next() else {
        return effects.refuse(0, Fault::Xml("the file has no element that is closed"));
    };
    let version = robot.value("version").and_then(version).unwrap_or((1, 0));
    let mut reader = Reader { version, effects };
    reader.versioned(robot)?;
    reader.well_formed(robot)?;
    reader.robot(robot)?;
    reader.other_root(robot, file.bytes);
    Ok(())
}

/// Elements in each other, from which no other root is looked for.
const MAX_DEPTH: usize = 1000;

/// Two whole numbers with a point between them.
fn version(text: &str) -> Option<(u32, u32)> {
    let (major, minor) = text.trim().split_once('.')?;
    Some((major.parse().ok()?, minor.parse().ok()?))
}

/// The text of an attribute, or of an element that stands for it.
struct Value<'t> {
    at: usize,
    name: &'static str,
    text: &'t str,
}

struct Reader<'r> {
    version: (u32, u32),
    effects: &'r mut Effects,
}

impl Reader<'_> {
    /// What depends on the version: looked at first, and wherever it is in the file.
    fn versioned(&mut self, robot: Node<'_>) -> Reading<()> {
        let mut open = vec![robot];
        while let Some(node) = open.pop() {
            for child in node.children() {
                match (node.name(), child.name()) {
                    (_, "origin") => self.quaternion(child)?,
                    ("joint", "limit") if self.version >= (1, 2) => self.limit_of_1_2(child)?,
                    ("geometry", _) if self.version >= (1, 2) => self.sizes_of_1_2(child)?,
                    _ => {}
                }
                open.push(child);
            }
        }
        Ok(())
    }

    fn quaternion(&mut self, origin: Node<'_>) -> Reading<()> {
        let found = origin.attribute("quat_xyzw").filter(|_| self.version >= (1, 1));
        let Some(quaternion) = found else { return Ok(()) };
        if origin.attribute("rpy").is_some() {
            let fault = Fault::Other("`<origin>` has both `rpy` and `quat_xyzw`");
            return self.effects.refuse(quaternion, fault);
        }
        let pieces = quaternion.value.split_whitespace();
        match pieces.map(|piece| piece.parse().ok()).collect::<Option<Vec<f64>>>() {
            None => {
                self.effects.refuse(quaternion, Fault::not_a_number("quat_xyzw", &quaternion.value))
            }
            Some(numbers) if numbers.len() != 4 => {
                self.effects.refuse(quaternion, Fault::count("quat_xyzw", 4, &quaternion.value))
            }
            Some(_) => Ok(()),
        }
    }

    fn limit_of_1_2(&mut self, limit: Node<'_>) -> Reading<()> {
        let mut ends = [None; 2];
        let names =
            ["lower", "upper", "effort", "velocity", "acceleration", "deceleration", "jerk"];
        for (index, name) in names.into_iter().enumerate() {
            let Some(value) = limit.attribute(name) else { continue };
            let number = value.value.trim().parse::<f64>().ok().filter(|number| !number.is_nan());
            let Some(number) = number else {
                return self.effects.refuse(value, Fault::not_a_number(name, &value.value));
            };
            match ends.get_mut(index) {
                Some(end) => *end = Some(number),
                None if number < 0.0 => {
                    let fault = Fault::range(name, &value.value, "must not be negative");
                    return self.effects.refuse(value, fault);
                }
                None => {}
            }
        }
        if let [Some(lower), Some(upper)] = ends
            && upper < lower
        {
            return self.effects.refuse(limit, Fault::Other("`lower` is above `upper`"));
        }
        Ok(())
    }

    fn sizes_of_1_2(&mut self, form: Node<'_>) -> Reading<()> {
        let names: &[&str] = match form.name() {
            "sphere" => &["radius"],
            "box" => &["size"],
            "cylinder" | "capsule" => &["radius", "length"],
            _ => &[],
        };
        for value in names.iter().filter_map(|name| form.attribute(name)) {
            let mut numbers = value.value.split_whitespace().filter_map(|one| one.parse().ok());
            if !numbers.all(|number: f64| number.is_finite() && number > 0.0) {
                let rule = "URDF 1.2 has only sizes above 0";
                return self.effects.refuse(value, Fault::range(&value.name, &value.value, rule));
            }
        }
        Ok(())
    }

    /// A second parser reads what the first one kept, and knows more of XML.
    fn well_formed(&mut self, robot: Node<'_>) -> Reading<()> {
        let mut open = Vec::new();
        self.tag(robot)?;
        for part in robot.children() {
            match part.name() {
                "link" => {
                    self.tag(part)?;
                    let is_kept = |node: &Node<'_>| is_part_of_link(node.name());
                    open.extend(part.children().filter(is_kept));
                }
                "joint" | "material" => open.push(part),
                _ => {}
            }
        }
        while let Some(node) = open.pop() {
            self.tag(node)?;
            if node.text().is_some_and(|text| !text.chars().all(is_character)) {
                return self.effects.refuse(node, Fault::Xml("text has a control character"));
            }
            open.extend(node.children());
        }
        Ok(())
    }

    fn tag(&mut self, node: Node<'_>) -> Reading<()> {
        if !is_name(node.name()) {
            return self.effects.refuse(node, Fault::Xml("`<` is not followed by a name"));
        }
        for attribute in node.attributes() {
            if !is_name(&attribute.name) {
                return self
                    .effects
                    .refuse(attribute, Fault::Xml("a tag has something that is no attribute"));
            }
            if !attribute.value.chars().all(is_character) {
                return self.effects.refuse(attribute, Fault::Xml("text has a control character"));
            }
        }
        Ok(())
    }

    fn robot(&mut self, robot: Node<'_>) -> Reading<()> {
        for name in ["name", "version"] {
            self.attribute(robot, name)?;
        }
        for part in ["link", "joint", "material"] {
            self.no_attribute(robot, part)?;
        }
        for link in robot.named("link") {
            self.link(link)?;
        }
        for joint in robot.named("joint") {
            self.joint(joint)?;
        }
        for material in robot.named("material") {
            let name = self.needed(material, "name")?.text;
            self.material(material, &format!("material/{name}"))?;
        }
        Ok(())
    }

    /// The robot may be in another element than the first one.
    fn other_root(&mut self, root: Node<'_>, bytes: &[u8]) {
        let all = tinyxml::parse(bytes, MAX_DEPTH).unwrap_or_default();
        let mut others = all.tops().filter(|top| top.name() == "robot");
        let other = others.find(|other| other.start() > root.start()).map(Node::start);
        let is_empty = root.name() != "robot" && root.child("link").is_none();
        let (at, fault) = match other {
            Some(at) => (at, Fault::Other("the file has another root before")),
            None if is_empty => (root.start(), Fault::NotRobot),
            None => return,
        };
        for part in ["link", "joint"] {
            self.effects.drop(at, part, fault.clone());
        }
    }

    fn link(&mut self, link: Node<'_>) -> Reading<()> {
        let Some(name) = self.attribute(link, "name")? else {
            return self.effects.refuse(link, Fault::Missing("name"));
        };
        let part = format!("link/{}", name.value);
        for element in ["visual", "collision"] {
            self.no_attribute(link, element)?;
        }
        if let Some(inertial) = self.element(link, "inertial")? {
            self.inertial(inertial, &format!("{part}/inertial"))?;
        }
        self.no_inertial_between(link)?;
        for kind in ["visual", "collision"] {
            for (index, shape) in link.named(kind).enumerate() {
                self.shape(shape, &format!("{part}/{kind}/{index}"))?;
            }
        }
        Ok(())
    }

    /// Visuals are a list only if no inertial is between them.
    fn no_inertial_between(&mut self, link: Node<'_>) -> Reading<()> {
        let mut parts = link.children().filter(|node| matches!(node.name(), "visual" | "inertial"));
        let mut between = parts.clone().skip_while(|node| node.name() == "inertial");
        let has_before = between.any(|node| node.name() == "inertial");
        match between.find(|node| node.name() == "visual").filter(|_| has_before) {
            Some(_) => {
                let at = parts.find(|node| node.name() == "inertial").unwrap_or(link);
                let fault = Fault::Other("`<inertial>` is between two `<visual>`");
                self.effects.refuse(at, fault)
            }
            None => Ok(()),
        }
    }

    fn inertial(&mut self, inertial: Node<'_>, part: &str) -> Reading<()> {
        self.pose(inertial, part)?;
        let mass = self.needed_element(inertial, "mass")?;
        self.number(mass, "value", true)?;
        let inertia = self.needed_element(inertial, "inertia")?;
        for name in ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"] {
            self.number(inertia, name, true)?;
        }
        Ok(())
    }

    /// A visual or collision.
    fn shape(&mut self, shape: Node<'_>, part: &str) -> Reading<()> {
        self.value(shape, "name")?;
        self.pose(shape, part)?;
        let geometry = self.needed_element(shape, "geometry")?;
        self.geometry(geometry, part)?;
        if shape.name() == "visual"
            && let Some(material) = self.element(shape, "material")?
        {
            self.needed(material, "name")?;
            let part = format!("{part}/material");
            self.material(material, &part)?;
            if material.children().all(|node| !matches!(node.name(), "color" | "texture")) {
                let fault = Fault::Other("the material is named only, and nothing looks it up");
                self.effects.drop(material, part, fault);
            }
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'_>, part: &str) -> Reading<()> {
        if geometry.text().is_some() {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has text"));
        }
        let mut forms = geometry.children();
        let Some(form) = forms.next() else {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has no shape"));
        };
        let sizes: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "cylinder" | "capsule" => &["radius", "length"],
            "box" => {
                let size = self.needed(form, "size")?;
                self.vector(size, 3, part)?;
                &[]
            }
            "mesh" => {
                self.needed(form, "filename")?;
                if let Some(scale) = self.value(form, "scale")? {
                    self.vector(scale, 3, part)?;
                }
                &[]
            }
            other => return self.effects.refuse(form, Fault::Shape(shortened(other))),
        };
        for name in sizes {
            self.number(form, name, true)?;
        }
        match forms.next() {
            Some(second) => {
                let fault = Fault::Other("`<geometry>` has more than one element");
                self.effects.refuse(second, fault)
            }
            None => Ok(()),
        }
    }

    fn material(&mut self, material: Node<'_>, part: &str) -> Reading<()> {
        if let Some(color) = self.element(material, "color")? {
            let rgba = self.needed(color, "rgba")?;
            self.vector(rgba, 4, part)?;
        }
        if let Some(texture) = self.element(material, "texture")? {
            self.needed(texture, "filename")?;
        }
        Ok(())
    }

    fn pose(&mut self, parent: Node<'_>, part: &str) -> Reading<()> {
        let Some(origin) = self.element(parent, "origin")? else { return Ok(()) };
        let part = format!("{part}/origin");
        for name in ["xyz", "rpy"] {
            if let Some(value) = self.value(origin, name)? {
                self.vector(value, 3, &part)?;
            }
        }
        let Some(quaternion) = origin.attribute("quat_xyzw") else { return Ok(()) };
        if self.version < (1, 1) {
            self.effects.drop(quaternion, part, Fault::NeverRead("quat_xyzw".into()));
        }
        Ok(())
    }

    fn joint(&mut self, joint: Node<'_>) -> Reading<()> {
        let part = format!("joint/{}", self.needed(joint, "name")?.text);
        let kind = self.needed(joint, "type")?;
        let known =
            ["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];
        if !known.contains(&kind.text) {
            return self.effects.refuse(kind.at, Fault::value("type", kind.text));
        }
        self.pose(joint, &part)?;
        for name in ["parent", "child"] {
            let end = self.needed_element(joint, name)?;
            self.needed(end, "link")?;
        }
        if let Some(axis) = self.element(joint, "axis")? {
            let xyz = self.needed(axis, "xyz")?;
            self.vector(xyz, 3, &format!("{part}/axis"))?;
        }
        let is_limited = matches!(kind.text, "revolute" | "prismatic");
        match self.element(joint, "limit")? {
            Some(limit) => self.limit(limit, &format!("{part}/limit"))?,
            None if is_limited => {
                let fault = Fault::MissingElement("limit");
                self.effects.read_as(joint, format!("{part}/limit"), fault, "0 to 0");
            }
            None => {}
        }
        self.numbers(joint, "calibration", &["rising", "falling"], &[])?;
        self.numbers(joint, "dynamics", &["damping", "friction"], &[])?;
        let soft = ["soft_lower_limit", "soft_upper_limit", "k_position"];
        self.numbers(joint, "safety_controller", &soft, &["k_velocity"])?;
        if let Some(mimic) = self.numbers(joint, "mimic", &["multiplier", "offset"], &[])? {
            self.needed(mimic, "joint")?;
        }
        Ok(())
    }

    fn limit(&mut self, limit: Node<'_>, part: &str) -> Reading<()> {
        const FURTHER: [&str; 3] = ["acceleration", "deceleration", "jerk"];
        let is_1_2 = self.version >= (1, 2);
        for name in ["lower", "upper", "effort", "velocity"] {
            // From 1.2 each is written before the limit is read.
            if let Some(second) = limit.child(name).filter(|_| is_1_2) {
                return self.effects.refuse(second, Fault::Repeated(name.into()));
            }
            self.number(limit, name, name == "velocity" && !is_1_2)?;
        }
        for name in FURTHER {
            match limit.attribute(name).filter(|_| !is_1_2) {
                Some(unread) => {
                    self.effects.drop(unread, part, Fault::NeverRead(name.into()));
                }
                None => self.number(limit, name, false)?,
            }
        }
        Ok(())
    }

    /// An element with numbers, some of which are needed.
    fn numbers<'t>(
        &mut self,
        joint: Node<'t>,
        element: &'static str,
        optional: &[&'static str],
        needed: &[&'static str],
    ) -> Reading<Option<Node<'t>>> {
        let Some(node) = self.element(joint, element)? else { return Ok(None) };
        for name in optional {
            self.number(node, name, false)?;
        }
        for name in needed {
            self.number(node, name, true)?;
        }
        Ok(Some(node))
    }

    fn number(&mut self, node: Node<'_>, name: &'static str, is_needed: bool) -> Reading<()> {
        let value = match is_needed {
            true => self.needed(node, name)?,
            false => match self.value(node, name)? {
                Some(value) => value,
                None => return Ok(()),
            },
        };
        match value.text.trim().parse::<f64>() {
            Ok(_) => Ok(()),
            Err(_) => self.effects.refuse(value.at, Fault::not_a_number(name, value.text)),
        }
    }

    /// So many numbers among pieces of text: what is no number is left out.
    fn vector(&mut self, value: Value<'_>, count: usize, part: &str) -> Reading<()> {
        let pieces = value.text.split_whitespace();
        let numbers: Vec<&str> =
            pieces.clone().filter(|piece| piece.parse::<f64>().is_ok()).collect();
        let fault = Fault::count(value.name, count, value.text);
        if numbers.len() != count {
            return self.effects.refuse(value.at, fault);
        }
        if pieces.count() != count {
            self.effects.read_as(value.at, part, fault, numbers.join(" "));
        }
        Ok(())
    }

    /// An attribute that no element can stand for.
    fn attribute<'t>(
        &mut self,
        node: Node<'t>,
        name: &'static str,
    ) -> Reading<Option<&'t Attribute<'t>>> {
        // With prefixes, there may be two of a name.
        let mut found = node.attributes().iter().filter(|one| one.name == name);
        let first = found.next();
        match found.next() {
            Some(second) => self.effects.refuse(second, Fault::Repeated(name.into())),
            None => Ok(first),
        }
    }

    /// An attribute, or an element with its text.
    fn value<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<Option<Value<'t>>> {
        let attribute = self.attribute(node, name)?;
        let mut elements = node.named(name);
        let element = elements.next();
        let second = if attribute.is_some() { element } else { elements.next() };
        if let Some(second) = second {
            return self.effects.refuse(second, Fault::Repeated(name.into()));
        }
        if let Some(inside) = element.and_then(|element| element.children().next()) {
            return self.effects.refuse(inside, Fault::Missing(name));
        }
        let written = attribute.map(|one| Value { at: one.at(), name, text: &one.value });
        Ok(written.or_else(|| {
            let element = element?;
            let text = element.text().unwrap_or_default().trim();
            Some(Value { at: element.start(), name, text })
        }))
    }

    fn needed<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<Value<'t>> {
        match self.value(node, name)? {
            Some(value) => Ok(value),
            None => self.effects.refuse(node, Fault::Missing(name)),
        }
    }

    fn no_attribute(&mut self, node: Node<'_>, name: &'static str) -> Reading<()> {
        match node.attribute(name) {
            Some(attribute) => {
                let fault = Fault::Other("an attribute has the name of an element");
                self.effects.refuse(attribute, fault)
            }
            None => Ok(()),
        }
    }

    /// An element that may stand once.
    fn element<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<Option<Node<'t>>> {
        self.no_attribute(node, name)?;
        let mut found = node.named(name);
        let first = found.next();
        match found.next() {
            Some(second) => self.effects.refuse(second, Fault::Repeated(name.into())),
            None => Ok(first),
        }
    }

    fn needed_element<'t>(&mut self, node: Node<'t>, name: &'static str) -> Reading<Node<'t>> {
        match self.element(node, name)? {
            Some(element) => Ok(element),
            None => self.effects.refuse(node, Fault::MissingElement(name)),
        }
    }
}

fn is_part_of_link(name: &str) -> bool {
    matches!(name, "visual" | "inertial" | "collision")
}

/// A name without a prefix, as XML has it.
fn is_name(name: &str) -> bool {
    let is_start = |one: char| one.is_ascii_alphabetic() || one == '_' || !one.is_ascii();
    let is_inside = |one: char| is_start(one) || one.is_ascii_digit() || matches!(one, '-' | '.');
    name.starts_with(is_start) && name.chars().all(is_inside)
}

/// A character that XML 1.0 allows.
fn is_character(one: char) -> bool {
    matches!(one, '\t' | '\n' | '\r' | ' '..='\u{fffd}' | '\u{10000}'..)
}
