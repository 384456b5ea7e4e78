//! PyBullet 3.2.7: `loadURDF` with its default flags. It reads URDF by code of its own, which takes any text for a
//! number, and never reads mimics, calibrations and safety controllers.

use std::collections::{HashMap, HashSet};

use crate::effect::{Effects, Reading};
use crate::fault::{Fault, shortened};
use crate::file::File;
use crate::mesh::Mesh;
use crate::number::{is_space, strtod};
use crate::tinyxml;
use crate::tree::{Attribute, Node};

/// Elements nested in each other, from which tinyxml2 as it is built there refuses.
const MAX_DEPTH: usize = 99;
/// Names of robots and joints are copied into so many bytes.
const NAME_BYTES: usize = 1024;

pub(crate) fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let bytes = as_lines(file.bytes);
    let tree = tinyxml::parse(&bytes, MAX_DEPTH)
        .or_else(|bad| effects.refuse(bad.at, Fault::Xml(bad.why)))?;
    let Some(robot) = tree.tops().find(|top| top.name() == "robot") else {
        return effects.refuse(0, Fault::NotRobot);
    };
    let mut reader = Reader { file, effects, materials: HashSet::new() };
    reader.robot(robot)
}

/// The file in lines of at most 8,191 bytes, as it is read: a longer line is broken, and what follows a carriage return is
/// lost. The places in it are those of the file where no line was changed.
fn as_lines(bytes: &[u8]) -> std::borrow::Cow<'_, [u8]> {
    const LONGEST: usize = 8191;
    let is_plain = bytes.split(|&byte| byte == b'\n').all(|line| {
        let returns = line.iter().position(|&byte| byte == b'\r');
        line.len() <= LONGEST && !line.contains(&0) && returns.is_none_or(|at| at + 1 == line.len())
    });
    if is_plain {
        return bytes.into();
    }
    let mut lines = Vec::with_capacity(bytes.len());
    for line in bytes.split(|&byte| byte == b'\n') {
        for piece in line.chunks(LONGEST) {
            let end = piece.iter().position(|&byte| byte == b'\r').unwrap_or(piece.len());
            let plain = piece[..end].iter().map(|&byte| if byte == 0 { b'\n' } else { byte });
            lines.extend(plain);
            lines.push(b'\n');
        }
    }
    lines.into()
}

struct Reader<'r> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// The names of materials that are defined somewhere.
    materials: HashSet<String>,
}

/// A joint, for the tree.
struct Joint<'t> {
    node: Node<'t>,
    name: &'t str,
    parent: &'t str,
    child: &'t str,
}

impl Reader<'_> {
    fn robot(&mut self, robot: Node<'_>) -> Reading<()> {
        let Some(name) = robot.value("name") else {
            return self.effects.refuse(robot, Fault::Missing("name"));
        };
        self.name_fits(robot, "robot", name)?;
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            if !self.materials.insert(name.to_owned()) {
                let part = format!("material/{name}");
                self.effects.drop(material, part, Fault::not_unique("material", name));
                continue;
            }
            self.material(material, &format!("material/{name}"));
        }
        let mut links = HashMap::new();
        for link in robot.named("link") {
            let Some(name) = link.value("name") else {
                return self.effects.refuse(link, Fault::Missing("name"));
            };
            if links.insert(name, link).is_some() {
                return self.effects.refuse(link, Fault::not_unique("link", name));
            }
            self.name_fits(link, "link", name)?;
            self.link(link, name)?;
        }
        if links.is_empty() {
            return self.effects.refuse(robot, Fault::MissingElement("link"));
        }
        let mut joints = HashSet::new();
        let mut all = Vec::new();
        for node in robot.named("joint") {
            let joint = self.joint(node, &links)?;
            if !joints.insert(joint.name) {
                return self.effects.crash(node, Fault::not_unique("joint", joint.name));
            }
            all.push(joint);
        }
        self.tree(robot, &links, &all)
    }

    fn name_fits(&mut self, node: Node<'_>, kind: &'static str, name: &str) -> Reading<()> {
        if name.len() < NAME_BYTES {
            return Ok(());
        }
        let rule = "the name has 1,024 bytes or more";
        self.effects.crash(node, Fault::Name { kind, name: shortened(name), rule })
    }

    fn material(&mut self, material: Node<'_>, part: &str) {
        if let Some(texture) = material.child("texture") {
            self.effects.drop(texture, part, Fault::NeverRead("texture".into()));
        }
        let color = material.child("color");
        if let Some(rgba) = color.and_then(|color| color.attribute("rgba"))
            && pieces(&rgba.value).len() != 4
        {
            let fault = Fault::count("rgba", 4, &rgba.value);
            self.effects.read_as(rgba, part, fault, "0 0 0 0");
        }
    }

    fn link(&mut self, link: Node<'_>, name: &str) -> Reading<()> {
        let part = format!("link/{name}");
        match link.child("inertial") {
            Some(inertial) => self.inertial(inertial, &format!("{part}/inertial"))?,
            None if name == "world" => {}
            None if name.contains("%s") || name.contains("%n") => {
                let rule = "a warning about its missing inertial takes it for a format";
                return self
                    .effects
                    .crash(link, Fault::Name { kind: "link", name: shortened(name), rule });
            }
            None => {
                let fault = Fault::MissingElement("inertial");
                self.effects.read_as(link, format!("{part}/inertial"), fault, "mass 1");
            }
        }
        for kind in ["visual", "collision"] {
            for (index, shape) in link.named(kind).enumerate() {
                self.shape(shape, &format!("{part}/{kind}/{index}"))?;
            }
        }
        Ok(())
    }

    fn inertial(&mut self, inertial: Node<'_>, part: &str) -> Reading<()> {
        self.pose(inertial, part);
        for (element, attributes) in [("mass", &["value"][..]), ("inertia", &["ixx", "iyy", "izz"])]
        {
            let Some(node) = inertial.child(element) else {
                return self.effects.refuse(inertial, Fault::MissingElement(element));
            };
            for attribute in attributes {
                match node.attribute(attribute) {
                    Some(value) if element == "mass" => self.number(value, part),
                    Some(_) => {}
                    None => return self.effects.refuse(node, Fault::Missing(attribute)),
                }
            }
            if element == "inertia" {
                let makes = "that of its mass in the shape of its collisions";
                self.effects.read_as(node, part, Fault::NeverRead("inertia".into()), makes);
            }
        }
        Ok(())
    }

    fn shape(&mut self, shape: Node<'_>, part: &str) -> Reading<()> {
        self.pose(shape, part);
        let Some(geometry) = shape.child("geometry") else {
            return self.effects.refuse(shape, Fault::MissingElement("geometry"));
        };
        let Some(form) = geometry.children().next() else {
            return self.effects.refuse(geometry, Fault::Other("`<geometry>` has no shape"));
        };
        let needed: &[&str] = match form.name() {
            "sphere" => &["radius"],
            "box" => &["size"],
            "cylinder" | "capsule" => &["radius", "length"],
            "mesh" => return self.mesh(form, part).and_then(|()| self.own_material(shape, part)),
            "plane" => &["normal"],
            "cdf" => &["filename"],
            other => return self.effects.refuse(form, Fault::Shape(shortened(other))),
        };
        for &attribute in needed {
            let Some(value) = form.attribute(attribute) else {
                return self.effects.refuse(form, Fault::Missing(attribute));
            };
            match attribute {
                "size" => self.vector(value, part, "0 0 0"),
                "radius" | "length" => self.number(value, part),
                _ => {}
            }
        }
        self.own_material(shape, part)
    }

    fn own_material(&mut self, shape: Node<'_>, part: &str) -> Reading<()> {
        if shape.name() != "visual" {
            return Ok(());
        }
        let Some(material) = shape.child("material") else { return Ok(()) };
        let Some(name) = material.value("name") else {
            return self.effects.refuse(material, Fault::Missing("name"));
        };
        if material.children().any(|child| matches!(child.name(), "color" | "texture" | "specular"))
        {
            self.materials.insert(name.to_owned());
            self.material(material, &format!("{part}/material"));
        }
        Ok(())
    }

    fn mesh(&mut self, mesh: Node<'_>, part: &str) -> Reading<()> {
        let Some(filename) = mesh.attribute("filename") else {
            return self.effects.refuse(mesh, Fault::Missing("filename"));
        };
        if let Some(scale) = mesh.attribute("scale")
            && pieces(&scale.value).len() < 3
        {
            let one = atof(&scale.value);
            let fault = Fault::count("scale", 3, &scale.value);
            self.effects.read_as(scale, part, fault, format!("{one} {one} {one}"));
        }
        let name = &*filename.value;
        let end = name.len().checked_sub(4).and_then(|at| name.get(at..)).unwrap_or("");
        let end = end.to_ascii_lowercase();
        if name.len() <= 4 || ![".dae", ".stl", ".obj", ".cdf", ".vtk"].contains(&&*end) {
            let fault = Fault::Mesh("the mesh is in a format that the program cannot read");
            return self.effects.refuse(filename, fault);
        }
        let bad = match self.file.mesh(name) {
            Mesh::Missing => {
                return self
                    .effects
                    .refuse(filename, Fault::Mesh("the file of the mesh was not found"));
            }
            Mesh::Unknown => None,
            Mesh::Found(facts) => match &*end {
                ".stl" if !facts.is_binary_stl() => Some("the mesh is no binary STL file"),
                ".stl" if facts.triangles == 0 => Some("the mesh has no triangle"),
                ".obj" | ".dae" if facts.triangles == 0 => Some("the mesh has no triangle"),
                _ => None,
            },
        };
        if let Some(why) = bad {
            self.effects.drop(filename, part, Fault::Mesh(why));
        }
        Ok(())
    }

    fn pose(&mut self, parent: Node<'_>, part: &str) {
        let Some(origin) = parent.child("origin") else { return };
        for value in ["xyz", "rpy"].into_iter().filter_map(|name| origin.attribute(name)) {
            self.vector(value, part, "0 0 0");
        }
        if let Some(quaternion) = origin.attribute("quat_xyzw") {
            self.effects.drop(quaternion, part, Fault::NeverRead("quat_xyzw".into()));
        }
    }

    /// Three numbers. Fewer are none at all, and what follows is left out.
    fn vector(&mut self, value: &Attribute<'_>, part: &str, none: &str) {
        let pieces = pieces(&value.value);
        let fault = Fault::count(&value.name, 3, &value.value);
        if pieces.len() < 3 {
            self.effects.read_as(value, part, fault, none);
        } else if pieces.len() > 3 || pieces.iter().any(|piece| !is_whole(piece)) {
            let read: Vec<String> =
                pieces[..3].iter().map(|piece| atof(piece).to_string()).collect();
            self.effects.read_as(value, part, fault, read.join(" "));
        }
    }

    fn number(&mut self, value: &Attribute<'_>, part: &str) {
        if !is_whole(&value.value) {
            let fault = Fault::not_a_number(&value.name, &value.value);
            self.effects.read_as(value, part, fault, atof(&value.value).to_string());
        }
    }

    fn joint<'t>(&mut self, node: Node<'t>, links: &HashMap<&str, Node<'_>>) -> Reading<Joint<'t>> {
        let Some(name) = node.value("name") else {
            return self.effects.refuse(node, Fault::Missing("name"));
        };
        if name.is_empty() {
            return self.effects.crash(node, Fault::Empty("name"));
        }
        self.name_fits(node, "joint", name)?;
        let part = format!("joint/{name}");
        self.pose(node, &format!("{part}/origin"));
        let parent = self.end(node, "parent")?;
        let child = self.end(node, "child")?;
        let Some(kind) = node.attribute("type") else {
            return self.effects.crash(node, Fault::Missing("type"));
        };
        let known = ["revolute", "continuous", "prismatic", "fixed", "planar", "spherical"];
        if kind.value == "floating" {
            self.effects.read_as(kind, &*part, Fault::value("type", "floating"), "fixed");
        } else if !known.contains(&&*kind.value) {
            return self.effects.refuse(kind, Fault::value("type", &kind.value));
        }
        if !matches!(&*kind.value, "fixed" | "floating")
            && let Some(axis) = node.child("axis")
        {
            self.axis(axis, &format!("{part}/axis"))?;
        }
        self.limit(node, &kind.value, &format!("{part}/limit"))?;
        if let Some(dynamics) = node.child("dynamics") {
            let values = ["damping", "friction"].map(|name| dynamics.attribute(name));
            if values.iter().all(Option::is_none) {
                let fault = Fault::Other("`<dynamics>` has neither damping nor friction");
                return self.effects.refuse(dynamics, fault);
            }
            for value in values.into_iter().flatten() {
                self.number(value, &format!("{part}/dynamics"));
            }
        }
        for unread in ["mimic", "calibration", "safety_controller"] {
            if let Some(found) = node.child(unread) {
                self.effects.drop(
                    found,
                    format!("{part}/{unread}"),
                    Fault::NeverRead(unread.into()),
                );
            }
        }
        for (end, name) in [(child, "child"), (parent, "parent")] {
            if !links.contains_key(end) {
                let place = node.child(name).unwrap_or(node);
                return self.effects.refuse(place, Fault::unknown("link", end));
            }
        }
        Ok(Joint { node, name, parent, child })
    }

    /// The name of a joint's parent or child.
    fn end<'t>(&mut self, joint: Node<'t>, name: &'static str) -> Reading<&'t str> {
        let Some(end) = joint.child(name) else {
            return self.effects.refuse(joint, Fault::MissingElement(name));
        };
        match end.value("link") {
            Some("") => self.effects.refuse(end, Fault::Empty("link")),
            Some(link) => Ok(link),
            None if name == "child" => self.effects.crash(end, Fault::Missing("link")),
            None => self.effects.refuse(end, Fault::Missing("link")),
        }
    }

    fn axis(&mut self, axis: Node<'_>, part: &str) -> Reading<()> {
        let Some(xyz) = axis.attribute("xyz") else {
            self.effects.read_as(axis, part, Fault::Missing("xyz"), "whatever the memory has");
            return Ok(());
        };
        if pieces(&xyz.value).len() < 3 {
            return self.effects.refuse(xyz, Fault::count("xyz", 3, &xyz.value));
        }
        self.vector(xyz, part, "");
        let numbers = pieces(&xyz.value).into_iter().take(3).map(atof);
        if numbers.fold(0.0, |sum, number| sum + number * number) == 0.0 {
            let fault = Fault::range("xyz", &xyz.value, "an axis has no length 0");
            self.effects.read_as(xyz, part, fault, "nan");
        }
        Ok(())
    }

    fn limit(&mut self, joint: Node<'_>, kind: &str, part: &str) -> Reading<()> {
        let Some(limit) = joint.child("limit") else {
            return match kind {
                "revolute" | "prismatic" => {
                    self.effects.refuse(joint, Fault::MissingElement("limit"))
                }
                _ => Ok(()),
            };
        };
        let values = ["lower", "upper", "effort", "velocity"].map(|name| limit.attribute(name));
        for value in values.into_iter().flatten() {
            self.number(value, part);
        }
        let end = |value: Option<&Attribute<'_>>, default| {
            value.map_or(default, |value| atof(&value.value))
        };
        let (lower, upper) = (end(values[0], 0.0), end(values[1], -1.0));
        if matches!(kind, "revolute" | "prismatic") && lower > upper {
            let fault = match values[1] {
                Some(_) => Fault::Other("`lower` is above `upper`"),
                None => Fault::Missing("upper"),
            };
            self.effects.read_as(limit, part, fault, "no limit");
        }
        Ok(())
    }

    fn tree(
        &mut self,
        robot: Node<'_>,
        links: &HashMap<&str, Node<'_>>,
        joints: &[Joint<'_>],
    ) -> Reading<()> {
        let mut children: HashMap<&str, Vec<&str>> = HashMap::new();
        let mut has_parent = HashSet::new();
        for joint in joints {
            children.entry(joint.parent).or_default().push(joint.child);
            has_parent.insert(joint.child);
        }
        let mut roots: Vec<_> = links
            .iter()
            .filter(|(name, _)| !has_parent.contains(*name))
            .map(|(name, node)| (node.start(), *name))
            .collect();
        roots.sort_unstable();
        match roots[..] {
            [] => return self.effects.refuse(robot, Fault::Tree("no link is the root")),
            [_] => {}
            [_, (second, _), ..] => {
                return self
                    .effects
                    .crash(second, Fault::Tree("two links have no joint above them"));
            }
        }
        let mut reached = HashSet::from([roots[0].1]);
        let mut open = vec![roots[0].1];
        while let Some(link) = open.pop() {
            for &child in children.get(link).into_iter().flatten() {
                if !reached.insert(child) {
                    let at = joints
                        .iter()
                        .rfind(|joint| joint.child == child)
                        .map_or(robot, |joint| joint.node);
                    return self
                        .effects
                        .crash(at, Fault::Tree("a link is the child of two joints"));
                }
                open.push(child);
            }
        }
        let fault = Fault::Tree("it is in a loop, which the root does not reach");
        for (name, node) in links.iter().filter(|(name, _)| !reached.contains(*name)) {
            self.effects.drop(*node, format!("link/{name}"), fault.clone());
        }
        for joint in joints.iter().filter(|joint| !reached.contains(joint.child)) {
            self.effects.drop(joint.node, format!("joint/{}", joint.name), fault.clone());
        }
        Ok(())
    }
}

/// Pieces between spaces alone.
fn pieces(text: &str) -> Vec<&str> {
    text.split(' ').filter(|piece| !piece.is_empty()).collect()
}

/// `atof`: the number that a text begins with, or 0.
fn atof(text: &str) -> f64 {
    strtod(text).map_or(0.0, |(number, _)| number)
}

/// Whether `atof` reads all of a text, and a finite number.
fn is_whole(text: &str) -> bool {
    strtod(text).is_some_and(|(number, rest)| {
        rest.trim_start_matches(is_space).is_empty() && number.is_finite()
    })
}
