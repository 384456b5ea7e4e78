//! urdf-usd-converter 0.3.4, with which Isaac Sim and Newton import URDF. It is strict about XML, names and numbers
//! anywhere in the file. Links that have nothing in them, at the end of fixed joints, have no joint in USD.

mod parse;
mod tree;

use crate::file;
use crate::number::python;
use crate::prelude::*;
use tree::{Joint, last};

pub const ABOUT: About = About {
    id: "usd",
    name: "Isaac and Newton (urdf-usd-converter)",
    family: "Isaac and Newton",
    version: "0.3.4",
    settings: &["isaac", "newton"],
    is_asked: true,
    is_for: None,
    names: Names::Expanded,
    never: &["version quat_xyzw", FURTHER],
    read,
};

pub fn read(file: &File, effects: &mut Effects) -> Reading<()> {
    let text = match std::str::from_utf8(file.bytes) {
        Ok(text) => text,
        Err(bad) => {
            return effects.refuse(bad.valid_up_to(), Fault::Xml("the file is not UTF-8"));
        }
    };
    let (read, of_read);
    // A parser skips the declaration at the beginning, too.
    let is_whole = text.rfind("<?xml").unwrap_or(0) == 0 && text.matches("?>").count() < 2;
    let [tree, _] = match &file.strict {
        Some(Ok(trees)) if is_whole => trees,
        _ => {
            read = parse::without_declarations(text);
            of_read = effects.parsed(file::trees(&read, None))?;
            &of_read
        }
    };
    let robot = effects.robot(tree)?;
    let before = effects.unread_parts();
    parse::elements(robot, effects)?;
    let mut reader = UsdReader { file, effects, materials: HashMap::new() };
    // Python reads all elements before it asks for what they mean.
    reader.effects.are_read(before)?;
    reader.robot(robot)
}

struct UsdReader<'r, 't> {
    file: &'r File<'r>,
    effects: &'r mut Effects,
    /// Whether the first material of each name has a colour or a texture, and which; those of the robot have one.
    materials: HashMap<&'t str, (bool, Option<Look>)>,
}

impl<'t> UsdReader<'_, 't> {
    fn robot(&mut self, robot: Node<'t>) -> Reading<()> {
        self.name(robot);
        let links = self.unique(robot, "link");
        let materials = self.unique(robot, "material");
        let joints = self.joints(robot, &links);
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            self.look(material, &Part::of("material", name));
        }
        let looks = materials.into_iter().map(|(name, node)| (name, (true, Look::of(node))));
        self.materials = looks.collect();
        for link in robot.named("link") {
            self.materials_of(link);
        }
        let Some(first) = robot.child("link") else {
            return self.effects.refuse(robot, Fault::MissingElement("link"));
        };
        let kept = tree::find(robot, first, &links, &joints?, self.effects)?;
        for link in kept {
            self.link(link);
        }
        Ok(())
    }

    /// The robot's name is that of a file.
    fn name(&mut self, robot: Node<'t>) {
        const LONGEST: usize = 248;
        let Some(attribute) = robot.attribute("name") else { return };
        let name = &*attribute.value;
        let fault = Fault::name("robot", name, "it is the name of a file, too");
        if name.contains('\\') {
            self.effects.drop(attribute, "robot/?", fault.clone());
        }
        let has_slash = name.starts_with('/') || name.ends_with('/');
        if name.len() > LONGEST || has_slash || name.contains(char::is_control) {
            self.effects.refuse_mendable(attribute, fault);
        }
    }

    /// The parts of one kind, by name.
    fn unique(&mut self, robot: Node<'t>, kind: &'static str) -> HashMap<&'t str, Node<'t>> {
        let mut found = HashMap::new();
        for node in robot.named(kind) {
            let name = node.value("name").unwrap_or_default();
            if found.insert(name, node).is_some() {
                self.effects.refuse_mendable(node, Fault::not_unique(kind, name));
            }
        }
        found
    }

    /// Of elements that repeat it reads the last, also if it is empty.
    fn repeated(&mut self, node: Node<'t>, names: &str, part: &Part) {
        for name in names.split(' ') {
            let mut all = node.named(name);
            let first = all.next().filter(|first| !first.is_empty());
            let emptied = first.and(all.last()).filter(|last| last.is_empty());
            if let Some(second) = node.repeated(name).or(emptied) {
                let fault = Fault::Repeated(name.into());
                self.effects.read_as(second, part.inside(name), fault, "the last");
            }
        }
    }

    fn joints(
        &mut self,
        robot: Node<'t>,
        links: &HashMap<&'t str, Node<'t>>,
    ) -> Reading<Vec<Joint<'t>>> {
        let by_name = self.unique(robot, "joint");
        let mut joints = Vec::new();
        let before = self.effects.unread_parts();
        for node in robot.named("joint") {
            let name = node.value("name").unwrap_or_default();
            let kind = node.value("type").unwrap_or_default();
            let [parent, child] = ["parent", "child"].map(|end| {
                let end = last(node, end);
                end.map(|end| (end, end.value("link").unwrap_or_default()))
            });
            let (Some(parent), Some(child)) = (parent, child) else {
                let end = if parent.is_none() { "parent" } else { "child" };
                let _ = self.effects.refuse::<()>(node, Fault::MissingElement(end));
                continue;
            };
            for (end, link) in [parent, child] {
                if !links.contains_key(link) {
                    let _ = self.effects.refuse::<()>(end, Fault::unknown("link", link));
                }
            }
            let mimicked = last(node, "mimic").and_then(|mimic| mimic.attribute("joint"));
            if let Some(mimicked) = mimicked.filter(|mimicked| !mimicked.value.is_empty())
                && !by_name.contains_key(&*mimicked.value)
            {
                let fault = Fault::unknown("joint", &mimicked.value);
                let _ = self.effects.refuse::<()>(mimicked, fault);
            }
            self.joint(node, kind, &Part::of("joint", name));
            joints.push(Joint { node, name, kind, parent: parent.1, child: child.1 });
        }
        self.effects.are_read(before)?;
        Ok(joints)
    }

    /// What is read otherwise of a joint.
    fn joint(&mut self, node: Node<'t>, kind: &str, part: &Part) {
        const PARTS: &str =
            "origin parent child axis limit dynamics calibration safety_controller mimic";
        self.repeated(node, PARTS, part);
        self.pose(node, part);
        let part = part.inside("limit");
        match last(node, "limit") {
            None if matches!(kind, "revolute" | "prismatic") => {
                self.effects.read_as(node, part, Fault::MissingElement("limit"), "locked at 0");
            }
            Some(limit) if kind == "planar" => {
                self.effects.drop(limit, part, Fault::Way("a planar joint has no limit in USD"));
            }
            Some(limit) => self.effects.unread_attributes(limit, FURTHER, &part),
            None => {}
        }
    }

    fn pose(&mut self, parent: Node<'t>, part: &Part) {
        let origin = last(parent, "origin");
        if let Some(unread) = origin.and_then(|origin| origin.attribute("quat_xyzw")) {
            self.effects.unread(unread, part.inside("origin"), "quat_xyzw");
        }
    }

    /// The materials of a link's visuals: the first of a name is that of all.
    fn materials_of(&mut self, link: Node<'t>) {
        let name = link.value("name").unwrap_or_default();
        for (visual, part) in Part::of("link", name).shapes(link, "visual") {
            let Some(material) = last(visual, "material") else { continue };
            let part = part.inside("material");
            let name = material.value("name").unwrap_or_default();
            let has_look = ["color", "texture"].iter().any(|look| material.child(look).is_some());
            if let Some((_, first)) = self.materials.get(name).filter(|_| !name.is_empty()) {
                Look::compare(first.as_ref(), material, &part, self.effects);
            } else {
                self.look(material, &part);
                self.materials.insert(name, (has_look, Look::of(material)));
            }
            if !self.materials.get(name).map_or(has_look, |(has_look, _)| *has_look) {
                let fault = Fault::unknown("material", name);
                self.effects.read_as(material, part, fault, "black and transparent");
            }
        }
    }

    fn look(&mut self, material: Node<'t>, part: &Part) {
        if let Some(rgba) = last(material, "color").and_then(|color| color.attribute("rgba")) {
            let opacity = rgba.value.split_whitespace().nth(3).and_then(python).unwrap_or(1.0);
            if !opacity.is_nan() && !(0.0..=1.0).contains(&opacity) {
                let fault = Fault::range(rgba, "opacity is from 0 to 1");
                self.effects.refuse_mendable(rgba, fault);
            }
        }
        let texture = last(material, "texture").and_then(|texture| texture.attribute("filename"));
        let Some(texture) = texture.filter(|name| !name.value.is_empty()) else { return };
        let name = &*texture.value;
        if let Some(color) = last(material, "color") {
            let fault = Fault::Other("the texture is in the place of the colour");
            self.effects.drop(color, part, fault);
        }
        if is_elsewhere(name) || matches!(name, "." | "..") || name.ends_with('/') {
            let fault = Fault::Other("the name of the texture is not that of a file");
            self.effects.refuse_mendable(texture, fault);
        } else if matches!(self.file.mesh(name), Mesh::Missing) {
            self.effects.drop(texture, part, Fault::NotFound("texture"));
        }
    }

    fn link(&mut self, link: Node<'t>) {
        let part = Part::of("link", link.value("name").unwrap_or_default());
        self.repeated(link, "inertial", &part);
        if let Some(inertial) = last(link, "inertial") {
            self.inertial(inertial, &part.inside("inertial"));
        }
        for kind in ["visual", "collision"] {
            for (shape, part) in part.shapes(link, kind) {
                self.repeated(shape, "origin geometry material", &part);
                self.pose(shape, &part);
                self.shape(shape, &part);
            }
        }
    }

    fn inertial(&mut self, inertial: Node<'t>, part: &Part) {
        self.repeated(inertial, "origin mass inertia", part);
        self.pose(inertial, part);
        let has = |name| inertial.child(name).is_some();
        if !["origin", "mass", "inertia"].into_iter().any(has) {
            self.effects.drop(inertial, part, Fault::Other("`<inertial>` is empty"));
        }
        // The principal axes of what is not finite are not found, but for some tensors that are not turned.
        let Some(inertia) = last(inertial, "inertia") else { return };
        let names: &[&str] = match has("origin") {
            true => &MOMENTS,
            false => &["ixz"],
        };
        for value in names.iter().filter_map(|name| inertia.attribute(name)) {
            if python(&value.value).is_some_and(|number| !number.is_finite()) {
                self.effects.refuse_mendable(value, Fault::range(value, "must be finite"));
            }
        }
    }

    fn shape(&mut self, shape: Node<'t>, part: &Part) {
        let Some(geometry) = last(shape, "geometry") else {
            return self.effects.drop(shape, part, Fault::MissingElement("geometry"));
        };
        let shapes = ["box", "sphere", "cylinder", "mesh"];
        let Some(form) = geometry.children().filter(|form| shapes.contains(&form.name())).last()
        else {
            match geometry.children().next() {
                Some(form) => self.effects.drop(form, part, Fault::Shape(form.name().into())),
                None => self.effects.drop(geometry, part, NO_SHAPE),
            }
            return;
        };
        let needed: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "cylinder" => &["radius", "length"],
            "mesh" => return self.mesh(form, part),
            _ => &[],
        };
        for name in needed {
            if form.attribute(name).is_none() {
                self.effects.refuse_mendable(form, Fault::Missing(name));
            }
        }
        if form.name() == "box" && form.attribute("size").is_none() {
            self.effects.read_as(form, part, Fault::Missing("size"), "0 0 0");
        }
    }

    fn mesh(&mut self, mesh: Node<'t>, part: &Part) {
        let Some(name) = mesh.attribute("filename").filter(|name| !name.value.is_empty()) else {
            return self.effects.drop(mesh, part, Fault::Missing("filename"));
        };
        if let Some(fault) = self.missing_mesh(name) {
            self.effects.drop(name, part, fault);
        }
    }

    fn missing_mesh(&self, name: &Attribute<'_>) -> Option<Fault> {
        let ending = name.value.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
        match self.file.mesh(&name.value) {
            _ if is_elsewhere(&name.value) => {
                Some(Fault::ForOthers("the name of the mesh is not that of a file"))
            }
            _ if !matches!(&*ending, "stl" | "obj" | "dae") => Some(format_fault(&name.value)),
            Mesh::Found(facts) if facts.leniency().is_some() => facts.leniency(),
            Mesh::Found(facts) => {
                let has_faces = match &*ending {
                    "stl" => is_stl(&facts),
                    "obj" => facts.obj.as_ref().is_some_and(|obj| obj.faces > 0),
                    _ => facts
                        .collada
                        .as_ref()
                        .is_some_and(|collada| collada.triangles > 0 && collada.has_instance),
                };
                (!has_faces).then_some(Fault::Mesh("the program finds nothing in the mesh"))
            }
            Mesh::Missing => Some(Fault::NotFound("mesh")),
            _ => None,
        }
    }
}

/// Whether it reads an STL file: one without two corners that are one point is none to it.
fn is_stl(facts: &MeshFacts) -> bool {
    const MOST: usize = 100_000_000;
    let Some(stl) = &facts.stl else { return false };
    match (stl.binary, stl.written) {
        (Some(_), _) => stl.shares_corners,
        _ if facts.head.starts_with(b"solid") => stl.corners > 3,
        (None, Some(count)) => (1..=MOST).contains(&count) && facts.size >= 84 + 50,
        (None, None) => false,
    }
}

/// Whether a name is of no file: `http://...`, or a package without a file in it.
fn is_elsewhere(name: &str) -> bool {
    match name.split_once("://") {
        Some(("package", path)) => path.split('/').filter(|part| !part.is_empty()).count() < 2,
        Some(("file", _)) | None => false,
        Some(_) => true,
    }
}
