//! yourdfpy 0.0.60: `URDF.load` with its defaults, which shows visuals with their meshes. It reads XML by libxml2, and
//! recovers what it can of a file that is not well-formed; numbers are those of Python.

mod shown;

use std::collections::HashMap;

use crate::effect::{At, Effects, Reading};
use crate::fault::{Fault, shortened};
use crate::file::File;
use crate::number::python;
use crate::recover;
use crate::strict::{Names, Text};
use crate::tree::{Attribute, Node, Tree};

/// libxml2 parses no deeper.
const MAX_DEPTH: usize = 256;

pub(crate) fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let text = Text::declared(file.bytes);
    let (tree, bad) = match text.parse(Names::Expanded) {
        Ok(tree) if tree.depth() <= MAX_DEPTH => (tree, None),
        Ok(_) => recovered(&text, 0, "elements are nested too deep"),
        Err(bad) => recovered(&text, bad.at, bad.why),
    };
    let Some(root) = tree.tops().next() else {
        let (at, why, _) = bad.unwrap_or((0, "the file has no element", true));
        return effects.refuse(at, Fault::Xml(why));
    };
    if let Some((at, why, is_whole)) = bad {
        let has_namespace = root.value("xmlns").is_some_and(|namespace| namespace.contains(':'));
        if has_namespace || root.name().contains(':') {
            return effects.refuse(at, Fault::Xml(why));
        }
        if !is_whole {
            effects.read_as(at, "robot/?", Fault::Xml(why), "what can be recovered");
        }
    }
    let mut reader = Reader { file, effects, materials: HashMap::new() };
    reader.robot(root)
}

/// The fault of a document: where, what, and whether all is read nevertheless.
type Bad = Option<(usize, &'static str, bool)>;

fn recovered<'t>(text: &'t Text<'_>, at: usize, why: &'static str) -> (Tree<'t>, Bad) {
    let (tree, is_whole) = recover::parse(&text.text);
    (text.placed(tree), Some((at, why, is_whole)))
}

struct Reader<'r, 't> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// The last material of the robot of each name.
    materials: HashMap<&'t str, Node<'t>>,
}

/// What it has of a joint.
struct Joint<'t> {
    node: Node<'t>,
    name: &'t str,
    kind: Option<&'t str>,
    mimics: Option<Node<'t>>,
}

impl Joint<'_> {
    fn is_actuated(&self) -> bool {
        self.mimics.is_none() && self.kind != Some("fixed")
    }

    fn moves(&self) -> bool {
        matches!(self.kind, Some("revolute" | "continuous" | "prismatic"))
    }
}

impl<'t> Reader<'_, 't> {
    fn robot(&mut self, robot: Node<'t>) -> Reading<()> {
        self.needed(robot, "name")?;
        let is_hidden = robot.attribute("xmlns").is_some() || robot.name().contains('{');
        if is_hidden {
            let fault = Fault::Other("`xmlns` gives all elements another name");
            self.effects.drop(robot, "link", fault.clone());
            self.effects.drop(robot, "joint", fault);
            return Ok(());
        }
        let links = robot.named("link");
        let mut names = HashMap::new();
        for link in links.clone() {
            let name = &*self.needed(link, "name")?.value;
            self.link(link, &format!("link/{name}"))?;
            if names.insert(name, 1_usize).is_some() {
                names.entry(name).and_modify(|count| *count += 1);
            }
        }
        let mut joints = Vec::new();
        for joint in robot.named("joint") {
            joints.push(self.joint(joint)?);
        }
        for material in robot.named("material") {
            self.color(material)?;
            self.materials.insert(material.value("name").unwrap_or_default(), material);
        }
        self.tree(&mut names, &joints)?;
        self.positions(&joints)?;
        for link in links {
            let part = format!("link/{}", link.value("name").unwrap_or_default());
            for (index, visual) in link.named("visual").enumerate() {
                self.shown(visual, &format!("{part}/visual/{index}"))?;
            }
        }
        Ok(())
    }

    fn link(&mut self, link: Node<'t>, part: &str) -> Reading<()> {
        if let Some(inertial) = link.child("inertial") {
            self.first(link, "inertial", part);
            let part = format!("{part}/inertial");
            self.origin(inertial, &part)?;
            if let Some(inertia) = inertial.child("inertia") {
                self.numbers(inertia, &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"])?;
                for name in ["ixx", "iyy", "izz"] {
                    if inertia.attribute(name).is_none() {
                        self.effects.read_as(inertia, &*part, Fault::Missing(name), "1");
                    }
                }
            }
            match inertial.child("mass") {
                Some(mass) => self.numbers(mass, &["value"])?,
                None => {
                    let fault = Fault::MissingElement("mass");
                    self.effects.read_as(inertial, part, fault, "no mass");
                }
            }
        }
        for kind in ["visual", "collision"] {
            for (index, shape) in link.named(kind).enumerate() {
                let part = format!("{part}/{kind}/{index}");
                self.geometry(shape)?;
                self.origin(shape, &part)?;
                if let Some(material) = shape.child("material").filter(|_| kind == "visual") {
                    self.color(material)?;
                    self.first(shape, "material", &part);
                }
            }
        }
        Ok(())
    }

    /// Of elements that repeat it reads the first.
    fn first(&mut self, parent: Node<'t>, name: &str, part: &str) {
        if let Some(second) = parent.repeated(name) {
            let part = format!("{part}/{name}");
            self.effects.read_as(second, part, Fault::Repeated(name.to_owned()), "the first");
        }
    }

    fn needed(&mut self, node: Node<'t>, name: &'static str) -> Reading<&'t Attribute<'t>> {
        match node.attribute(name) {
            Some(attribute) => Ok(attribute),
            None => self.effects.refuse(node, Fault::Missing(name)),
        }
    }

    fn vector(&mut self, value: &Attribute<'_>, text: &str) -> Reading<Vec<f64>> {
        match text.split_whitespace().map(python).collect() {
            Some(numbers) => Ok(numbers),
            None => self.effects.refuse(value, Fault::not_a_number(&value.name, &value.value)),
        }
    }

    fn number(&mut self, value: &Attribute<'_>) -> Reading<f64> {
        match python(&value.value) {
            Some(number) => Ok(number),
            None => self.effects.refuse(value, Fault::not_a_number(&value.name, &value.value)),
        }
    }

    fn numbers(&mut self, node: Node<'_>, names: &[&str]) -> Reading<()> {
        for value in names.iter().filter_map(|name| node.attribute(name)) {
            self.number(value)?;
        }
        Ok(())
    }

    fn geometry(&mut self, shape: Node<'t>) -> Reading<()> {
        let Some(geometry) = shape.child("geometry") else {
            return self.effects.refuse(shape, Fault::MissingElement("geometry"));
        };
        let Some(form) = geometry.children().next() else {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has no shape"));
        };
        let sizes: &[&'static str] = match form.name() {
            "box" => {
                let size = self.needed(form, "size")?;
                return self.vector(size, &size.value.replace(',', " ")).map(|_| ());
            }
            "mesh" => return self.scale(form).map(|_| ()),
            "cylinder" => &["radius", "length"],
            "sphere" => &["radius"],
            other => return self.effects.refuse(form, Fault::Shape(shortened(other))),
        };
        for name in sizes {
            let size = self.needed(form, name)?;
            self.number(size)?;
        }
        Ok(())
    }

    fn scale(&mut self, mesh: Node<'t>) -> Reading<Vec<f64>> {
        match mesh.attribute("scale") {
            Some(scale) => self.vector(scale, &scale.value.replace(',', " ")),
            None => Ok(Vec::new()),
        }
    }

    fn origin(&mut self, parent: Node<'t>, part: &str) -> Reading<()> {
        let Some(origin) = parent.child("origin") else { return Ok(()) };
        self.first(parent, "origin", part);
        let part = format!("{part}/origin");
        for name in ["xyz", "rpy"] {
            let Some(value) = origin.attribute(name) else { continue };
            let fault = Fault::count(name, 3, &value.value);
            match self.vector(value, &value.value)?.len() {
                3 => {}
                4.. => self.effects.read_as(value, &*part, fault, "the first three"),
                1 if name == "xyz" => {
                    self.effects.read_as(value, &*part, fault, "three times that")
                }
                _ => return self.effects.refuse(value, fault),
            }
        }
        if let Some(unread) = origin.attribute("quat_xyzw") {
            self.effects.drop(unread, part, Fault::NeverRead("quat_xyzw".into()));
        }
        Ok(())
    }

    fn color(&mut self, material: Node<'t>) -> Reading<()> {
        match material.child("color").and_then(|color| color.attribute("rgba")) {
            Some(rgba) => self.vector(rgba, &rgba.value).map(|_| ()),
            None => Ok(()),
        }
    }

    fn joint(&mut self, node: Node<'t>) -> Reading<Joint<'t>> {
        let name = &*self.needed(node, "name")?.value;
        let part = format!("joint/{name}");
        for end in ["parent", "child"] {
            if node.child(end).is_none() {
                return self.effects.refuse(node, Fault::MissingElement(end));
            }
            self.first(node, end, &part);
        }
        self.origin(node, &part)?;
        let parts: [(&str, &[&str]); 4] = [
            ("limit", &["effort", "velocity", "lower", "upper"]),
            ("mimic", &["multiplier", "offset"]),
            ("calibration", &["rising", "falling"]),
            (
                "safety_controller",
                &["soft_lower_limit", "soft_upper_limit", "k_position", "k_velocity"],
            ),
        ];
        if let Some(xyz) = node.child("axis").and_then(|axis| axis.attribute("xyz")) {
            self.vector(xyz, &xyz.value)?;
        }
        for (name, numbers) in parts {
            let Some(element) = node.child(name) else { continue };
            self.numbers(element, numbers)?;
            self.first(node, name, &part);
        }
        self.nothing(node, "dynamics", &["damping", "friction"], &part);
        let kind = node.value("type");
        if !matches!(kind, Some("continuous" | "fixed")) {
            self.nothing(node, "limit", &["lower", "upper"], &part);
        }
        let known = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];
        if kind.is_none_or(|kind| !known.contains(&kind)) {
            let (at, fault) = match node.attribute("type") {
                Some(kind) => (kind.at(), Fault::value("type", &kind.value)),
                None => (node.start(), Fault::Missing("type")),
            };
            self.effects.read_as(at, part, fault, "fixed");
        }
        Ok(Joint { node, name, kind, mimics: node.child("mimic") })
    }

    /// What is missing is no number, and not 0.
    fn nothing(&mut self, joint: Node<'t>, name: &str, values: &[&'static str], part: &str) {
        let Some(element) = joint.child(name) else { return };
        for value in values.iter().filter(|value| element.attribute(value).is_none()) {
            let part = format!("{part}/{name}");
            self.effects.read_as(element, part, Fault::Missing(value), "none");
        }
    }

    /// Each joint takes its child from the list of links: it must be there, and once for each joint.
    fn tree(&mut self, links: &mut HashMap<&str, usize>, joints: &[Joint<'t>]) -> Reading<()> {
        for joint in joints {
            let end = |name| joint.node.child(name).unwrap_or(joint.node);
            let child = end("child");
            let Some(link) = child.attribute("link") else {
                return self.effects.refuse(child, Fault::Missing("link"));
            };
            match links.get_mut(&*link.value) {
                Some(0) => {
                    let fault = Fault::Tree("a link is the child of two joints");
                    return self.effects.refuse(child, fault);
                }
                Some(count) => *count -= 1,
                None => return self.effects.refuse(link, Fault::unknown("link", &link.value)),
            }
        }
        Ok(())
    }

    /// The poses of joints at zero. A joint of an unknown kind has no place in a configuration, but is counted.
    fn positions(&mut self, joints: &[Joint<'t>]) -> Reading<()> {
        let mut actuated = HashMap::new();
        let (mut places, mut size) = (0, 0);
        for joint in joints.iter().filter(|joint| joint.is_actuated()) {
            let count = actuated.len();
            actuated.entry(joint.name).or_insert(count);
            let of_kind = match joint.kind {
                Some("floating") => 6,
                Some("planar") => 2,
                _ => usize::from(joint.moves()),
            };
            size += of_kind;
            places += usize::from(of_kind > 0);
        }
        let fault = Fault::Other("a joint of an unknown type is in the place of this one");
        for joint in joints {
            let mimicked = joint.mimics.and_then(|mimic| mimic.attribute("joint"));
            let driver = mimicked.and_then(|mimicked| actuated.get(&*mimicked.value));
            match joint.mimics {
                Some(mimic) if driver.is_some_and(|driver| *driver >= size) => {
                    return self.effects.refuse(mimic, fault);
                }
                Some(mimic) if driver.is_none() => {
                    let name = mimic.value("joint").unwrap_or_default();
                    let part = format!("joint/{}/mimic", joint.name);
                    let fault = Fault::unknown("joint that moves by itself", name);
                    self.effects.read_as(mimic, part, fault, "its offset alone");
                }
                _ => {}
            }
            if !joint.moves() {
                continue;
            }
            let place = actuated.get(joint.name).copied().unwrap_or(0);
            if joint.mimics.is_none() && place >= places {
                return self.effects.refuse(joint.node, fault);
            }
            let Some(xyz) = joint.node.child("axis").and_then(|axis| axis.attribute("xyz")) else {
                continue;
            };
            let count = xyz.value.split_whitespace().count();
            if count < 3 || (count > 3 && joint.kind == Some("prismatic")) {
                return self.effects.refuse(xyz, Fault::count("xyz", 3, &xyz.value));
            }
        }
        Ok(())
    }
}
