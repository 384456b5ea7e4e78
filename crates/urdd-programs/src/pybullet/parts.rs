//! How PyBullet reads visuals, collisions and joints, and what it makes a tree of.

use crate::effect::Color;
use crate::prelude::*;
use crate::pybullet::{Links, MOST_LINKS, PybulletReader, atof, is_defined, pieces, rgba};

/// In how many folders above the file it looks for a mesh; they are all in truth.
const FOLDERS: usize = 8;

impl PybulletReader<'_> {
    pub fn shape(&mut self, shape: Node<'_>, part: &Part) -> Reading<()> {
        self.pose(shape, part);
        let geometry = self.effects.needed_element(shape, "geometry")?;
        let Some(form) = geometry.children().next() else {
            return self.effects.refuse(geometry, NO_SHAPE);
        };
        let needed: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "box" => &["size"],
            "cylinder" | "capsule" => &["radius", "length"],
            "plane" => &["normal"],
            "mesh" | "cdf" => &["filename"],
            other => return self.effects.refuse(form, Fault::Shape(other.into())),
        };
        for &name in needed {
            let value = self.effects.needed(form, name)?;
            match name {
                "size" => self.vector(value, part),
                "radius" | "length" => self.number(value, part),
                "filename" => self.mesh(form, value, part),
                _ => {}
            }
        }
        let material = shape.child("material").filter(|_| shape.name() == "visual");
        let Some(material) = material else { return Ok(()) };
        let name = &*self.effects.needed(material, "name")?.value;
        let part = part.inside("material");
        self.material(material, &part);
        let Some(known) = self.materials.get(name) else {
            if !name.is_empty() {
                self.effects.drop(material, part, Fault::unknown("material", name));
            }
            return Ok(());
        };
        let is_last = match is_defined(material) {
            true => Color::of(rgba(material)).is_same(&known.last),
            false => known.are_same,
        };
        if !is_last {
            let fault = Fault::not_unique("material", name);
            self.effects.read_as(material, part, fault, &known.last.text);
        }
        Ok(())
    }

    fn mesh(&mut self, mesh: Node<'_>, filename: &Attribute<'_>, part: &Part) {
        if let Some(scale) = mesh.attribute("scale") {
            match pieces(&scale.value).len() {
                0..3 => {
                    let one = atof(&scale.value);
                    let read = format!("{one} {one} {one}");
                    self.effects.read_as(scale, part, Fault::count(scale, 3), read);
                }
                _ => self.vector(scale, part),
            }
        }
        let name = &*filename.value;
        let end = name.len().checked_sub(4).and_then(|at| name.get(at..)).unwrap_or("");
        let end = end.to_ascii_lowercase();
        if name.len() <= 4 || ![".dae", ".stl", ".obj", ".cdf", ".vtk"].contains(&&*end) {
            return self.effects.refuse_mendable(filename, format_fault(name));
        }
        let fault = match self.found(name) {
            Mesh::Unknown => return,
            Mesh::NoPackage => NO_PACKAGE,
            Mesh::Missing if matches!(self.file.mesh(name), Mesh::Found(_)) => {
                let why =
                    "its package is in no folder above the file, and only there the program looks";
                Fault::ForOthers(why)
            }
            Mesh::Missing => Fault::NotFound("mesh"),
            Mesh::Found(facts) => return self.content(filename, &end, &facts, part),
        };
        self.effects.refuse_mendable(filename, fault);
    }

    /// A mesh by its path, without scheme, in the folder of the file and in those above.
    fn found(&self, name: &str) -> Mesh {
        let path = name.strip_prefix("file://").unwrap_or(name);
        let in_package = ["package://", "model://"].iter().find_map(|one| path.strip_prefix(one));
        let path = in_package.unwrap_or(path);
        if path.contains("://") {
            return Mesh::Missing;
        }
        // The root is one of these folders.
        let absolute = path.starts_with('/').then(|| self.file.mesh(path));
        let path = path.trim_start_matches('/');
        let places = (0..FOLDERS).map(|up| self.file.mesh(&format!("{}{path}", "../".repeat(up))));
        let found = absolute.into_iter().chain(places).find(|mesh| !matches!(mesh, Mesh::Missing));
        match (found, in_package.map(|_| self.file.mesh(name))) {
            (Some(mesh), _) | (None, Some(mesh @ (Mesh::Unknown | Mesh::NoPackage))) => mesh,
            _ => Mesh::Missing,
        }
    }

    /// What is wrong in a mesh file loses the mesh.
    fn content(&mut self, filename: &Attribute<'_>, end: &str, facts: &MeshFacts, part: &Part) {
        let why = match (end, &facts.stl, &facts.obj, &facts.collada) {
            (".stl", Some(stl), ..) if stl.binary.is_some_and(|count| count > 0) => return,
            (".stl", ..) => "the mesh is no binary STL file with triangles",
            (".obj", _, Some(obj), _) if obj.triangles > 0 && !obj.has_bad_index => return,
            (".obj", ..) => "the mesh is no OBJ file with triangles of its vertices",
            (".dae", .., Some(collada)) if !collada.is_complete => {
                let why = "the mesh has no `<asset>` or no `<library_geometries>`";
                return self.effects.crash_mendable(filename, Fault::Mesh(why));
            }
            (".dae", .., Some(collada)) if collada.has_text => {
                return self.effects.drop(filename, part, HAS_MORE);
            }
            (".dae", .., Some(collada)) if collada.triangles > 0 && collada.has_scene => return,
            (".dae", ..) => "the mesh is no COLLADA file with a scene of triangles",
            _ => {
                let fault = Fault::ForOthers("the format is not for meshes of links");
                return self.effects.drop(filename, part, fault);
            }
        };
        self.effects.drop(filename, part, Fault::Mesh(why));
    }
}

pub struct Joint<'t> {
    node: Node<'t>,
    name: &'t str,
    parent: &'t str,
    child: &'t str,
}

impl PybulletReader<'_> {
    pub fn joints<'t>(&mut self, robot: Node<'t>, links: &Links<'_>) -> Reading<Vec<Joint<'t>>> {
        let mut names = HashSet::new();
        let mut joints = Vec::new();
        let before = self.effects.unread_parts();
        for node in robot.named("joint") {
            let Ok(joint) = self.joint(node, links) else { continue };
            if !names.insert(joint.name) {
                let fault = Fault::not_unique("joint", joint.name);
                self.effects.crash_mendable(node, fault);
            }
            joints.push(joint);
        }
        self.effects.are_read(before)?;
        Ok(joints)
    }

    fn joint<'t>(&mut self, node: Node<'t>, links: &Links<'_>) -> Reading<Joint<'t>> {
        let name = self.named(node, "joint")?;
        if name.is_empty() {
            return self.effects.crash(node, Fault::Empty("name"));
        }
        let part = Part::of("joint", name);
        self.pose(node, &part.inside("origin"));
        let (parent, child) = (self.end(node, "parent", links)?, self.end(node, "child", links)?);
        let Some(kind) = node.attribute("type") else {
            return self.effects.crash(node, Fault::Missing("type"));
        };
        if !JOINT_TYPES.contains(&&*kind.value) && kind.value != "spherical" {
            return self.effects.refuse(kind, Fault::value("type", &kind.value));
        }
        let axis = node.child("axis");
        match &*kind.value {
            "fixed" => {}
            "floating" => {
                self.effects.read_as(kind, &part, Fault::value("type", "floating"), "fixed");
            }
            kind => {
                if let Some(axis) = axis {
                    self.axis(axis, kind, &part.inside("axis"));
                }
            }
        }
        self.limit(node, &kind.value, &part.inside("limit"));
        if let Some(dynamics) = node.child("dynamics") {
            let values = ["damping", "friction"].map(|name| dynamics.attribute(name));
            if values.iter().all(Option::is_none) {
                self.effects.refuse_mendable(dynamics, NO_DYNAMICS);
            }
            for value in values.into_iter().flatten() {
                self.number(value, &part.inside("dynamics"));
            }
        }
        self.effects.unread_elements(node, "mimic calibration safety_controller", &part);
        Ok(Joint { node, name, parent, child })
    }

    fn end<'t>(
        &mut self,
        joint: Node<'t>,
        name: &'static str,
        links: &Links<'_>,
    ) -> Reading<&'t str> {
        let end = self.effects.needed_element(joint, name)?;
        match end.value("link") {
            Some("") => self.effects.refuse(end, Fault::Empty("link")),
            Some(link) if links.places.contains_key(link) => Ok(link),
            Some(link) => self.effects.refuse(end, Fault::unknown("link", link)),
            None if name == "child" => self.effects.crash(end, Fault::Missing("link")),
            None => self.effects.refuse(end, Fault::Missing("link")),
        }
    }

    fn axis(&mut self, axis: Node<'_>, kind: &str, part: &Part) {
        let Some(xyz) = axis.attribute("xyz") else {
            let makes = "whatever the memory has";
            return self.effects.read_as(axis, part, Fault::Missing("xyz"), makes);
        };
        let pieces = pieces(&xyz.value);
        if pieces.len() < 3 {
            return self.effects.refuse_mendable(xyz, Fault::count(xyz, 3));
        }
        if kind == "spherical" {
            let fault = Fault::Way("a spherical joint has no axis");
            return self.effects.drop(axis, part, fault);
        }
        self.vector(xyz, part);
        if pieces[..3].iter().all(|piece| atof(piece) == 0.0) {
            self.effects.read_as(xyz, part, Fault::range(xyz, "an axis needs a length"), "nan");
        }
    }

    fn limit(&mut self, joint: Node<'_>, kind: &str, part: &Part) {
        let needs_limit = matches!(kind, "revolute" | "prismatic");
        let Some(limit) = joint.child("limit") else {
            if needs_limit {
                self.effects.refuse_mendable(joint, Fault::MissingElement("limit"));
            }
            return;
        };
        let values = ["lower", "upper", "effort", "velocity"].map(|name| limit.attribute(name));
        for value in values.into_iter().flatten() {
            self.number(value, part);
        }
        let end = |value: Option<&Attribute<'_>>, default| {
            value.map_or(default, |value| atof(&value.value))
        };
        if needs_limit && end(values[0], 0.0) > end(values[1], -1.0) {
            let fault = match values[1] {
                Some(_) => CROSSED,
                None => Fault::Missing("upper"),
            };
            self.effects.read_as(limit, part, fault, "no limit");
        }
    }

    pub fn tree(
        &mut self,
        robot: Node<'_>,
        links: &Links<'_>,
        joints: &[Joint<'_>],
    ) -> Reading<()> {
        let mut below: HashMap<&str, Vec<&Joint>> = HashMap::new();
        for joint in joints {
            below.entry(joint.parent).or_default().push(joint);
        }
        let children: HashSet<&str> = joints.iter().map(|joint| joint.child).collect();
        let mut roots = links.all.iter().filter(|(name, _)| !children.contains(name));
        let (root, node) = match (roots.next(), roots.next()) {
            (Some(root), None) => *root,
            (_, Some((_, second))) => {
                return self.effects.crash(*second, TWO_ROOTS);
            }
            (None, None) => return self.effects.refuse(robot, NO_ROOT),
        };
        if root.is_empty() {
            return self.effects.crash(node, Fault::Empty("name"));
        }
        let (mut reached, mut open) = (HashSet::from([root]), vec![root]);
        while let Some(link) = open.pop() {
            for joint in below.get(link).into_iter().flatten() {
                if !reached.insert(joint.child) {
                    return self.effects.crash(joint.node, TWO_PARENTS);
                }
                open.push(joint.child);
            }
        }
        self.unreached(links, joints, &reached)?;
        if let Some((_, link)) = links.all.get(MOST_LINKS + 1)
            && reached.len() > MOST_LINKS + 1
        {
            let fault = Fault::Other("a robot of more than 128 links can be asked for nothing");
            self.effects.drop(*link, "robot", fault);
        }
        Ok(())
    }

    /// Links that the root does not reach are left out. Memory is overwritten if they come before others.
    fn unreached(
        &mut self,
        links: &Links<'_>,
        joints: &[Joint<'_>],
        reached: &HashSet<&str>,
    ) -> Reading<()> {
        let lost = links.all.iter().filter(|(name, _)| !reached.contains(name));
        let last = links.all.iter().rposition(|(name, _)| reached.contains(name));
        for (name, node) in lost {
            if last.is_some_and(|last| last > reached.len().max(2)) {
                return self.effects.crash(*node, UNREACHED);
            }
            self.effects.drop(*node, Part::of("link", name), UNREACHED);
        }
        for joint in joints.iter().filter(|joint| !reached.contains(joint.child)) {
            self.effects.drop(joint.node, Part::of("joint", joint.name), UNREACHED);
        }
        Ok(())
    }
}
