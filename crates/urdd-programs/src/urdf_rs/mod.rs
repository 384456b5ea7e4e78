//! urdf-rs 0.10.0: `read_file`. It reads structures, and looks at neither the tree nor, below URDF 1.2, what numbers
//! mean. An element may stand for an attribute of its name.

mod again;
mod rustyxml;

use crate::effect::{At, Effects, Reading};
use crate::fault::{Fault, shortened};
use crate::file::File;
use crate::tinyxml;
use crate::tree::{Attribute, Node};

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
    again::check(robot, reader.effects)?;
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

/// What is in each element. A word is an element, or with `:` an attribute, for which an element may stand; `!` is behind
/// those that are needed. An attribute is text, a number (`1`), so many numbers, or the type of a joint.
const ELEMENTS: [(&str, &str); 23] = [
    ("inertial", "origin mass! inertia!"),
    ("mass", "value:1!"),
    ("inertia", "ixx:1! ixy:1! ixz:1! iyy:1! iyz:1! izz:1!"),
    ("visual", "name: origin geometry! material"),
    ("collision", "name: origin geometry!"),
    ("origin", "xyz:3 rpy:3"),
    ("box", "size:3!"),
    ("sphere", "radius:1!"),
    ("cylinder", "radius:1! length:1!"),
    ("capsule", "radius:1! length:1!"),
    ("mesh", "filename:! scale:3"),
    ("material", "name:! color texture"),
    ("color", "rgba:4!"),
    ("texture", "filename:!"),
    (
        "joint",
        "name:! type:type! origin parent! child! axis limit calibration dynamics mimic safety_controller",
    ),
    ("parent", "link:!"),
    ("child", "link:!"),
    ("axis", "xyz:3!"),
    // Below URDF 1.2. From then on, `limit_of_1_2` reads it.
    ("limit", "lower:1 upper:1 effort:1 velocity:1!"),
    ("calibration", "rising:1 falling:1"),
    ("dynamics", "damping:1 friction:1"),
    ("mimic", "joint:! multiplier:1 offset:1"),
    ("safety_controller", "soft_lower_limit:1 soft_upper_limit:1 k_position:1 k_velocity:1!"),
];

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
            let part = format!("joint/{}", joint.value("name").unwrap_or_default());
            self.fields(joint, &part)?;
            let is_limited = matches!(joint.value("type"), Some("revolute" | "prismatic"));
            if is_limited && joint.child("limit").is_none() {
                let fault = Fault::MissingElement("limit");
                self.effects.read_as(joint, format!("{part}/limit"), fault, "0 to 0");
            }
        }
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            self.fields(material, &format!("material/{name}"))?;
        }
        Ok(())
    }

    fn link(&mut self, link: Node<'_>) -> Reading<()> {
        let Some(name) = self.attribute(link, "name")? else {
            return self.effects.refuse(link, Fault::Missing("name"));
        };
        let part = format!("link/{}", name.value);
        if let Some(inertial) = self.element(link, "inertial")? {
            self.fields(inertial, &format!("{part}/inertial"))?;
        }
        self.no_inertial_between(link)?;
        for kind in ["visual", "collision"] {
            self.no_attribute(link, kind)?;
            for (index, shape) in link.named(kind).enumerate() {
                self.fields(shape, &format!("{part}/{kind}/{index}"))?;
            }
        }
        Ok(())
    }

    /// What is in an element. Goes as deep as the table does.
    fn fields(&mut self, node: Node<'_>, part: &str) -> Reading<()> {
        let found = ELEMENTS.iter().find(|(name, _)| *name == node.name());
        for word in found.into_iter().flat_map(|(_, words)| words.split_whitespace()) {
            let (word, is_needed) = match word.strip_suffix('!') {
                Some(word) => (word, true),
                None => (word, false),
            };
            let (name, kind) = word.split_once(':').unwrap_or((word, "element"));
            let fault = if kind == "element" {
                self.element(node, name)?.map(|one| self.inside(one, part)).transpose()?;
                node.child(name).is_none().then_some(Fault::MissingElement(name))
            } else {
                let value = self.value(node, name)?;
                let is_missing = value.is_none();
                value.map(|value| self.check(value, kind, part)).transpose()?;
                is_missing.then_some(Fault::Missing(name))
            };
            if let Some(fault) = fault.filter(|_| is_needed) {
                return self.effects.refuse(node, fault);
            }
        }
        Ok(())
    }

    /// An element of another, and what is said of it.
    fn inside(&mut self, node: Node<'_>, part: &str) -> Reading<()> {
        let own = format!("{part}/{}", node.name());
        let unread: &[&str] = match node.name() {
            "origin" if self.version < (1, 1) => &["quat_xyzw"],
            "limit" if self.version < (1, 2) => &["acceleration", "deceleration", "jerk"],
            "limit" => return self.limit_elements(node),
            "axis" => &[],
            "geometry" => return self.geometry(node, part),
            "material" => {
                self.fields(node, &own)?;
                if node.children().all(|one| !matches!(one.name(), "color" | "texture")) {
                    let fault = Fault::Other("the material is named only, and nothing looks it up");
                    self.effects.drop(node, own, fault);
                }
                return Ok(());
            }
            _ => return self.fields(node, part),
        };
        for attribute in unread.iter().filter_map(|name| node.attribute(name)) {
            self.effects.drop(attribute, &*own, Fault::NeverRead(attribute.name.to_string()));
        }
        self.fields(node, &own)
    }

    /// From 1.2 on, attributes are added to a limit before it is read: no element can stand for them.
    fn limit_elements(&mut self, limit: Node<'_>) -> Reading<()> {
        let names = ["lower", "upper", "effort", "velocity"];
        let is_value = |node: &Node<'_>| names.contains(&node.name());
        match limit.children().find(is_value) {
            Some(node) => self.effects.refuse(node, Fault::Repeated(shortened(node.name()))),
            None => Ok(()),
        }
    }

    fn check(&mut self, value: Value<'_>, kind: &str, part: &str) -> Reading<()> {
        const TYPES: [&str; 7] =
            ["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];
        match kind {
            "1" if value.text.trim().parse::<f64>().is_err() => {
                self.effects.refuse(value.at, Fault::not_a_number(value.name, value.text))
            }
            "type" if !TYPES.contains(&value.text) => {
                self.effects.refuse(value.at, Fault::value("type", value.text))
            }
            "3" => self.vector(value, 3, part),
            "4" => self.vector(value, 4, part),
            _ => Ok(()),
        }
    }

    fn geometry(&mut self, geometry: Node<'_>, part: &str) -> Reading<()> {
        if geometry.text().is_some() {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has text"));
        }
        let mut forms = geometry.children();
        let Some(form) = forms.next() else {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has no shape"));
        };
        if !["box", "sphere", "cylinder", "capsule", "mesh"].contains(&form.name()) {
            return self.effects.refuse(form, Fault::Shape(shortened(form.name())));
        }
        self.fields(form, part)?;
        match forms.next() {
            Some(second) => {
                let fault = Fault::Other("`<geometry>` has more than one element");
                self.effects.refuse(second, fault)
            }
            None => Ok(()),
        }
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

    /// Visuals are a list only if no inertial is between them.
    fn no_inertial_between(&mut self, link: Node<'_>) -> Reading<()> {
        let parts = link.children().filter(|node| matches!(node.name(), "visual" | "inertial"));
        let kinds: Vec<Node<'_>> = parts.collect();
        let inertial = kinds.iter().position(|node| node.name() == "inertial");
        match inertial.filter(|&at| at > 0 && at + 1 < kinds.len()) {
            Some(at) => {
                let fault = Fault::Other("`<inertial>` is between two `<visual>`");
                self.effects.refuse(kinds[at], fault)
            }
            None => Ok(()),
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
}
