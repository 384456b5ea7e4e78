//! urdfdom 6.0.0 and 4.0.1, with which all of ROS and Pinocchio read URDF. A fault in a joint refuses the file; a fault
//! in a link loses that part of the link and all that is read after it.

use std::collections::{BTreeMap, HashSet};

use crate::effect::{At, Effects, Reading};
use crate::fault::Fault;
use crate::file::File;
use crate::number::{istream, whole};
use crate::tree::{Attribute, Node, Tree};
use crate::{tinyxml, tinyxml1};

/// Open elements, the root among them, from which tinyxml2 refuses.
const MAX_DEPTH: usize = 499;

/// Which urdfdom.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Release {
    /// 4.0.1: URDF 1.0.
    Four,
    /// 6.0.0: URDF 1.0 to 1.2.
    Six,
}

/// What it has of a link.
pub(crate) struct Link<'t> {
    pub node: Node<'t>,
    /// How many visuals and collisions it reads, and whether these are all.
    pub kept: [(usize, bool); 2],
}

/// What it has of a joint.
pub(crate) struct Joint<'t> {
    pub node: Node<'t>,
    pub kind: &'t str,
    pub parent: &'t str,
    pub child: &'t str,
}

/// What it has of a robot.
pub(crate) struct Model<'t> {
    pub robot: Node<'t>,
    pub links: BTreeMap<&'t str, Link<'t>>,
    /// In the order of their names.
    pub joints: BTreeMap<&'t str, Joint<'t>>,
}

pub(crate) fn read_six(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree = parse(file, effects)?;
    model(&tree, Release::Six, effects).map(|_| ())
}

/// 3.0.1 reads as 4.0.1 does, but for the parser of its XML.
pub(crate) fn read_three(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree =
        tinyxml1::parse(file.bytes).or_else(|bad| effects.refuse(bad.at, Fault::Xml(bad.why)))?;
    model(&tree, Release::Four, effects).map(|_| ())
}

pub(crate) fn read_four(file: &File, effects: &mut Effects) -> Reading<()> {
    let tree = parse(file, effects)?;
    model(&tree, Release::Four, effects).map(|_| ())
}

/// The XML.
pub(crate) fn parse<'a>(file: &File<'a>, effects: &mut Effects) -> Reading<Tree<'a>> {
    tinyxml::parse(file.bytes, MAX_DEPTH).or_else(|bad| effects.refuse(bad.at, Fault::Xml(bad.why)))
}

/// The robot.
pub(crate) fn model<'t>(
    tree: &'t Tree<'t>,
    release: Release,
    effects: &mut Effects,
) -> Reading<Model<'t>> {
    let Some(robot) = tree.tops().find(|top| top.name() == "robot") else {
        return effects.refuse(0, Fault::NotRobot);
    };
    if robot.attribute("name").is_none() {
        return effects.refuse(robot, Fault::Missing("name"));
    }
    let minor = match robot.attribute("version") {
        None => 0,
        Some(written) => match version(&written.value) {
            Some((1, 0)) => 0,
            Some((1, minor @ 1..=2)) if release == Release::Six => minor,
            _ => return effects.refuse(written, Fault::Version(written.value.to_string())),
        },
    };
    let mut reader = Reader { release, minor, effects, materials: HashSet::new() };
    reader.materials(robot)?;
    let links = reader.links(robot)?;
    let joints = reader.joints(robot)?;
    let model = Model { robot, links, joints };
    reader.tree(robot, &model)?;
    Ok(model)
}

/// Two whole numbers with a point between them.
fn version(text: &str) -> Option<(u32, u32)> {
    let text = text.strip_suffix('.').filter(|text| text.contains('.')).unwrap_or(text);
    let (major, minor) = text.split_once('.')?;
    let part = |text: &str| {
        let number: i64 = text.trim_start_matches(crate::number::is_space).parse().ok()?;
        // A number of 32 bits, as it is kept.
        (number >= 0).then_some(number as u32)
    };
    Some((part(major)?, part(minor)?))
}

struct Reader<'r> {
    release: Release,
    /// The version of URDF is 1 and this.
    minor: u32,
    effects: &'r mut Effects,
    /// Materials that are known.
    materials: HashSet<String>,
}

impl Reader<'_> {
    fn materials(&mut self, robot: Node<'_>) -> Reading<()> {
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            let part = format!("material/{name}");
            if material.attribute("name").is_none() {
                self.effects.drop(material, part, Fault::Missing("name"));
            } else if !self.color(material, &part) {
                let fault = Fault::Other("the material has no colour and no texture");
                self.effects.read_as(material, part, fault, "black");
            }
            if !self.materials.insert(name.to_owned()) {
                return self.effects.refuse(material, Fault::not_unique("material", name));
            }
        }
        Ok(())
    }

    /// Whether a material has a colour or a texture.
    fn color(&mut self, material: Node<'_>, part: &str) -> bool {
        let texture = material.child("texture").and_then(|node| node.attribute("filename"));
        if let Some(empty) = texture.filter(|filename| filename.value.is_empty()) {
            self.effects.drop(empty, part, Fault::Empty("filename"));
        }
        let texture = texture.is_some();
        let color = material.child("color").and_then(|node| node.attribute("rgba"));
        let Some(rgba) = color else { return texture };
        let numbers =
            pieces(&rgba.value).map(|piece| whole(istream(piece))).collect::<Option<Vec<f64>>>();
        match numbers {
            None => {
                let fault = Fault::not_a_number("rgba", &rgba.value);
                self.effects.read_as(rgba, part, fault, "black");
                texture
            }
            Some(numbers) if numbers.iter().any(|number| !(0.0..=1.0).contains(number)) => {
                let fault = Fault::range("rgba", &rgba.value, "a colour is of numbers from 0 to 1");
                self.effects.read_as(rgba, part, fault, "black");
                texture
            }
            Some(numbers) => {
                if numbers.len() != 4 {
                    let fault = Fault::count("rgba", 4, &rgba.value);
                    self.effects.read_as(rgba, part, fault, "black");
                }
                true
            }
        }
    }

    fn links<'t>(&mut self, robot: Node<'t>) -> Reading<BTreeMap<&'t str, Link<'t>>> {
        let mut links = BTreeMap::new();
        for node in robot.named("link") {
            let name = node.value("name").unwrap_or_default();
            let kept = match node.attribute("name") {
                Some(_) => self.link(node, name),
                None => {
                    self.effects.drop(node, format!("link/{name}"), Fault::Missing("name"));
                    [(0, true); 2]
                }
            };
            if links.insert(name, Link { node, kept }).is_some() {
                return self.effects.refuse(node, Fault::not_unique("link", name));
            }
        }
        match links.is_empty() {
            true => self.effects.refuse(robot, Fault::MissingElement("link")),
            false => Ok(links),
        }
    }

    /// Reads the parts of a link. The first that is faulty is lost, with all that come after it.
    fn link(&mut self, link: Node<'_>, name: &str) -> [(usize, bool); 2] {
        let mut bad = None;
        if let Some(inertial) = link.child("inertial") {
            let part = format!("link/{name}/inertial");
            if let Err((at, fault)) = self.inertial(inertial) {
                self.effects.drop(at, part, fault.clone());
                bad = Some((at, fault));
            }
        }
        let mut kept = [(0, true); 2];
        for (kind, kept) in ["visual", "collision"].into_iter().zip(&mut kept) {
            for (index, node) in link.named(kind).enumerate() {
                let part = format!("link/{name}/{kind}/{index}");
                if bad.is_none() {
                    bad = self.shape(node, &part).err();
                }
                match &bad {
                    None => kept.0 += 1,
                    Some((at, fault)) => {
                        kept.1 = false;
                        self.effects.drop(*at, part, fault.clone());
                    }
                }
            }
        }
        kept
    }

    fn inertial(&mut self, inertial: Node<'_>) -> Part<()> {
        self.pose(inertial)?;
        let mass = needed_element(inertial, "mass")?;
        number(needed(mass, "value")?)?;
        let inertia = needed_element(inertial, "inertia")?;
        for name in ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"] {
            number(needed(inertia, name)?)?;
        }
        Ok(())
    }

    /// A visual or collision.
    fn shape(&mut self, shape: Node<'_>, part: &str) -> Part<()> {
        self.pose(shape)?;
        let geometry = needed_element(shape, "geometry")?;
        self.geometry(geometry)?;
        let Some(material) = shape.child("material").filter(|_| shape.name() == "visual") else {
            return Ok(());
        };
        let name = &*needed(material, "name")?.value;
        if name.is_empty() || !self.materials.contains(name) {
            let part = format!("{part}/material");
            let is_defined = self.color(material, &part);
            if is_defined && !name.is_empty() {
                self.materials.insert(name.to_owned());
            } else if !is_defined {
                let fault = match name.is_empty() {
                    true => Fault::Other("the material has no name, no colour and no texture"),
                    false => Fault::unknown("material", name),
                };
                self.effects.drop(material, part, fault);
            }
        }
        Ok(())
    }

    fn geometry(&mut self, geometry: Node<'_>) -> Part<()> {
        let Some(form) = geometry.children().next() else {
            return Err((geometry.start(), Fault::Other("`<geometry>` has no shape")));
        };
        let sizes: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "cylinder" => &["length", "radius"],
            "capsule" if self.release == Release::Six => {
                if self.minor == 0 {
                    let why = "`<capsule>` needs URDF 1.1: write `version=\"1.1\"` on `<robot>`";
                    return Err((form.start(), Fault::Other(why)));
                }
                &["length", "radius"]
            }
            "box" => {
                let size = needed(form, "size")?;
                let sizes = vector(size, 3)?;
                return self.positive(size, &sizes);
            }
            "mesh" => {
                needed(form, "filename")?;
                return match form.attribute("scale") {
                    Some(scale) => vector(scale, 3).map(|_| ()),
                    None => Ok(()),
                };
            }
            other => return Err((form.start(), Fault::Shape(crate::fault::shortened(other)))),
        };
        for name in sizes {
            needed(form, name)?;
        }
        for name in sizes {
            let size = needed(form, name)?;
            let value = number(size)?;
            self.positive(size, &[value])?;
        }
        Ok(())
    }

    fn positive(&self, size: &Attribute<'_>, values: &[f64]) -> Part<()> {
        match self.minor >= 2 && !values.iter().all(|value| *value > 0.0) {
            true => {
                let rule = "URDF 1.2 has only sizes above 0";
                Err((size.range.start, Fault::range(&size.name, &size.value, rule)))
            }
            false => Ok(()),
        }
    }

    fn pose(&mut self, parent: Node<'_>) -> Part<()> {
        let Some(origin) = parent.child("origin") else { return Ok(()) };
        if let Some(xyz) = origin.attribute("xyz") {
            vector(xyz, 3)?;
        }
        let (rpy, quaternion) = (origin.attribute("rpy"), origin.attribute("quat_xyzw"));
        if let (Some(_), Some(second)) = (rpy, quaternion)
            && self.minor > 0
        {
            return Err((
                second.range.start,
                Fault::Other("`<origin>` has both `rpy` and `quat_xyzw`"),
            ));
        }
        if let Some(rpy) = rpy {
            vector(rpy, 3)?;
        }
        match quaternion {
            Some(quaternion) if self.minor > 0 => vector(quaternion, 4).map(|_| ()),
            _ => Ok(()),
        }
    }

    fn joints<'t>(&mut self, robot: Node<'t>) -> Reading<BTreeMap<&'t str, Joint<'t>>> {
        let mut joints = BTreeMap::new();
        for node in robot.named("joint") {
            let (name, joint) = match self.joint(node) {
                Ok(read) => read,
                Err((at, fault)) => return self.effects.refuse(at, fault),
            };
            if joints.insert(name, joint).is_some() {
                return self.effects.refuse(node, Fault::not_unique("joint", name));
            }
        }
        Ok(joints)
    }

    fn joint<'t>(&mut self, node: Node<'t>) -> Part<(&'t str, Joint<'t>)> {
        let name = &*needed(node, "name")?.value;
        self.pose(node)?;
        let end = |name| node.child(name).and_then(|end| end.value("link")).unwrap_or_default();
        let kind = needed(node, "type")?;
        let known = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];
        if !known.contains(&&*kind.value) {
            return Err((kind.range.start, Fault::value("type", &kind.value)));
        }
        if let Some(axis) =
            node.child("axis").filter(|_| !matches!(&*kind.value, "fixed" | "floating"))
        {
            match axis.attribute("xyz") {
                Some(xyz) => drop(vector(xyz, 3)?),
                None => {
                    let part = format!("joint/{name}/axis");
                    self.effects.read_as(axis, part, Fault::Missing("xyz"), "0 0 0");
                }
            }
        }
        let is_limited = matches!(&*kind.value, "revolute" | "prismatic");
        match node.child("limit") {
            Some(limit) => self.limit(limit, is_limited, &format!("joint/{name}/limit"))?,
            None if is_limited => return Err((node.start(), Fault::MissingElement("limit"))),
            None => {}
        }
        if let Some(safety) = node.child("safety_controller") {
            numbers(safety, &["soft_lower_limit", "soft_upper_limit", "k_position"])?;
            number(needed(safety, "k_velocity")?)?;
        }
        if let Some(calibration) = node.child("calibration") {
            numbers(calibration, &["rising", "falling"])?;
        }
        if let Some(mimic) = node.child("mimic") {
            needed(mimic, "joint")?;
            numbers(mimic, &["multiplier", "offset"])?;
        }
        if let Some(dynamics) = node.child("dynamics") {
            if ["damping", "friction"].iter().all(|name| dynamics.attribute(name).is_none()) {
                let fault = Fault::Other("`<dynamics>` has neither damping nor friction");
                return Err((dynamics.start(), fault));
            }
            numbers(dynamics, &["damping", "friction"])?;
        }
        let (parent, child) = (end("parent"), end("child"));
        Ok((name, Joint { node, kind: &kind.value, parent, child }))
    }

    fn limit(&mut self, limit: Node<'_>, is_limited: bool, part: &str) -> Part<()> {
        const FURTHER: [&str; 3] = ["acceleration", "deceleration", "jerk"];
        numbers(limit, &["lower", "upper"])?;
        if self.minor < 2 {
            for name in ["effort", "velocity"] {
                number(needed(limit, name)?)?;
            }
            for unread in FURTHER.iter().filter_map(|name| limit.attribute(name)) {
                self.effects.drop(unread, part, Fault::NeverRead(unread.name.to_string()));
            }
            return Ok(());
        }
        let mut ends = [None; 2];
        for (name, end) in ["lower", "upper"].into_iter().zip(&mut ends) {
            *end = match is_limited {
                true => Some(number(needed(limit, name)?)?),
                false => limit.attribute(name).map(number).transpose()?,
            };
        }
        if let [Some(lower), Some(upper)] = ends
            && lower > upper
        {
            return Err((limit.start(), Fault::Other("`lower` is above `upper`")));
        }
        for value in
            ["effort", "velocity"].iter().chain(&FURTHER).filter_map(|name| limit.attribute(name))
        {
            if number(value)? < 0.0 {
                let fault = Fault::range(&value.name, &value.value, "must not be negative");
                return Err((value.range.start, fault));
            }
        }
        Ok(())
    }

    fn tree(&mut self, robot: Node<'_>, model: &Model<'_>) -> Reading<()> {
        let mut children = HashSet::new();
        for joint in model.joints.values() {
            let ends = [("parent", joint.parent), ("child", joint.child)];
            for (name, link) in ends {
                if link.is_empty() {
                    let fault = match joint.node.child(name) {
                        None => Fault::MissingElement(name),
                        Some(end) if end.attribute("link").is_some() => Fault::Empty("link"),
                        Some(_) => Fault::Missing("link"),
                    };
                    return self
                        .effects
                        .refuse(joint.node.child(name).unwrap_or(joint.node), fault);
                }
            }
            for (name, link) in [ends[1], ends[0]] {
                if !model.links.contains_key(link) {
                    let at = joint.node.child(name).unwrap_or(joint.node);
                    return self.effects.refuse(at, Fault::unknown("link", link));
                }
            }
            children.insert(joint.child);
        }
        let roots = model.links.iter().filter(|(name, _)| !children.contains(*name));
        let mut roots: Vec<usize> = roots.map(|(_, link)| link.node.start()).collect();
        roots.sort_unstable();
        match roots[..] {
            [] => self.effects.refuse(robot, Fault::Tree("no link is the root")),
            [_] => Ok(()),
            [_, second, ..] => {
                self.effects.refuse(second, Fault::Tree("two links have no joint above them"))
            }
        }
    }
}

/// A part that may be faulty: where, and why.
type Part<T> = Result<T, (usize, Fault)>;

fn needed<'t>(node: Node<'t>, name: &'static str) -> Part<&'t Attribute<'t>> {
    node.attribute(name).ok_or((node.start(), Fault::Missing(name)))
}

fn needed_element<'t>(node: Node<'t>, name: &'static str) -> Part<Node<'t>> {
    node.child(name).ok_or((node.start(), Fault::MissingElement(name)))
}

/// A number without anything behind it.
fn number(value: &Attribute<'_>) -> Part<f64> {
    let read = whole(istream(&value.value));
    read.ok_or_else(|| (value.at(), Fault::not_a_number(&value.name, &value.value)))
}

/// Numbers that may be left out.
fn numbers(node: Node<'_>, names: &[&str]) -> Part<()> {
    names
        .iter()
        .filter_map(|name| node.attribute(name))
        .try_for_each(|value| number(value).map(|_| ()))
}

/// Numbers with spaces, and nothing else, between them.
fn vector(value: &Attribute<'_>, count: usize) -> Part<Vec<f64>> {
    let numbers: Option<Vec<f64>> =
        pieces(&value.value).map(|piece| whole(istream(piece))).collect();
    match numbers {
        None => Err((value.at(), Fault::not_a_number(&value.name, &value.value))),
        Some(numbers) if numbers.len() != count => {
            Err((value.at(), Fault::count(&value.name, count, &value.value)))
        }
        Some(numbers) => Ok(numbers),
    }
}

fn pieces(text: &str) -> impl Iterator<Item = &str> {
    text.split(' ').filter(|piece| !piece.is_empty())
}
