//! Links: inertials, visuals, collisions, and the meshes of these: binary STL and OBJ.

use std::sync::Arc;

use crate::mujoco::reader::{Body, LEAST, LEAST_EIGENVALUE, MujocoReader, Release, eigenvalues};
use crate::number::{Matrix, Pose};
use crate::prelude::*;

/// The density of collisions, kg per cubic metre.
const DENSITY: f64 = 1000.0;
/// A collision of less mass adds nothing.
const LEAST_GEOM: f64 = 1e-14;

/// What of a shape counts for its inertia: volume, and the moments of 1 kg about its own axes.
pub struct Solid {
    pub volume: f64,
    pub moments: [f64; 3],
}

impl Solid {
    pub fn cuboid(volume: f64, size: [f64; 3]) -> Solid {
        let [x, y, z] = size.map(|side| side * side / 12.0);
        Solid { volume, moments: [y + z, x + z, x + y] }
    }
}

impl MujocoReader<'_> {
    pub fn link(&mut self, link: Node<'_>, name: &str) -> Reading<Body> {
        let part = Part::of("link", name);
        let before = self.effects.unread_parts();
        let own = match self.only(link, "inertial") {
            Ok(Some(inertial)) => self.inertial(inertial, name).ok(),
            _ => None,
        };
        let mut solids = Vec::new();
        for (visual, part) in part.shapes(link, "visual") {
            let _ = self.own_material(visual);
            match self.settings.has_visuals {
                true => solids.extend(self.geom(visual, &part)),
                false => self.effects.unread(visual, part, "visual"),
            }
        }
        for (collision, part) in part.shapes(link, "collision") {
            solids.extend(self.geom(collision, &part));
        }
        self.effects.are_read(before)?;
        let body = match own {
            Some(body) if !self.settings.ignores_inertials || solids.is_empty() => body,
            _ => self.body_of(link, name, &solids)?,
        };
        let [mass, moment] = self.settings.least;
        Ok(Body {
            mass: if body.mass < mass { mass } else { body.mass },
            moments: body.moments.map(|one| if one < moment { moment } else { one }),
            ..body
        })
    }

    fn own_material(&mut self, visual: Node<'_>) -> Reading<()> {
        let Some(material) = self.only(visual, "material")? else { return Ok(()) };
        match self.only(material, "color")? {
            Some(color) => self.color(color).map(|_| ()),
            None => self.text(material, "name").map(|_| ()),
        }
    }

    fn inertial(&mut self, inertial: Node<'_>, name: &str) -> Reading<Body> {
        let part = Part::of("link", name).inside("inertial");
        let before = self.effects.unread_parts();
        let mut pose = self.origin(inertial, &part).unwrap_or_default();
        if self.release == Release::Three && pose.turn != Pose::default().turn {
            let rpy = inertial.child("origin").and_then(|origin| origin.attribute("rpy"));
            let at = rpy.map_or(inertial.start(), |rpy| rpy.range.start);
            self.effects.unread(at, part.inside("origin"), "rpy");
            pose.turn = Pose::default().turn;
        }
        let mass = self.needed(inertial, "mass")?;
        let [kilograms] = self.needed_numbers(mass, "value")?;
        let node = self.needed(inertial, "inertia")?;
        let mut six = [0.0; 6];
        for (name, value) in ["ixx", "iyy", "izz", "ixy", "ixz", "iyz"].into_iter().zip(&mut six) {
            [*value] = self.needed_numbers(node, name).unwrap_or_default();
        }
        self.effects.are_read(before)?;
        if kilograms < 0.0 || kilograms.is_nan() {
            let fault = Fault::Inertia("a mass that is not above 0 is 0");
            self.effects.read_as(mass, &part, fault, "0");
        }
        let kilograms = if kilograms < 0.0 { 0.0 } else { kilograms };
        let moments = self.moments(node, &mut six, name);
        let [ixx, iyy, izz, ixy, ixz, iyz] = six;
        let tensor = match moments {
            [0.0, 0.0, 0.0] => [[0.0; 3]; 3],
            _ => [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]],
        };
        Ok(Body { moments, ..Body::new(kilograms, &pose, &tensor) })
    }

    /// The eigenvalues of a tensor. A tensor of zeros is none; one that is refused is another from here on.
    fn moments(&mut self, node: Node<'_>, six: &mut [f64; 6], name: &str) -> [f64; 3] {
        const MENDED: [f64; 6] = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
        let [ixx, iyy, izz, ixy, ixz, iyz] = *six;
        if *six == [0.0; 6] {
            return [0.0; 3];
        }
        if six.iter().any(|value| !value.is_finite()) {
            let fault = Fault::Inertia("a number of it is not finite");
            self.effects.read_as(node, Part::of("link", name).inside("inertial"), fault, "0");
            return [0.0; 3];
        }
        let moments = eigenvalues(
            &[[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]],
            self.release.epsilon(),
        );
        let is_bound = self.release == Release::Four && self.settings.least[1] > 0.0;
        if moments[2] < LEAST_EIGENVALUE && !is_bound {
            let fault = Fault::Inertia("the inertia has an eigenvalue that is not above 0");
            self.effects.refuse_mendable(node, fault);
            *six = MENDED;
            return [1.0; 3];
        }
        if moments[2] + moments[1] < moments[0] && name != "world" {
            if self.settings.balances {
                return [moments.iter().sum::<f64>() / 3.0; 3];
            }
            let why = "a moment of inertia is above the sum of the other two";
            self.effects.refuse_mendable(node, Fault::Inertia(why));
            *six = MENDED;
            return [1.0; 3];
        }
        moments
    }

    /// A link without an inertial.
    fn body_of(&mut self, link: Node<'_>, name: &str, solids: &[(Solid, Pose)]) -> Reading<Body> {
        if !solids.is_empty() && name != "world" {
            let fault = Fault::Way("the link has no `<inertial>`");
            let part = Part::of("link", name).inside("inertial");
            self.effects.read_as(link, part, fault, "the collisions filled with water");
        }
        let mut sum: Option<Body> = None;
        for (solid, pose) in solids {
            let mass = DENSITY * solid.volume;
            if mass.is_nan() || mass <= LEAST_GEOM {
                continue;
            }
            let moments = solid.moments.map(|moment| moment * mass);
            let [x, y, z] = moments;
            let tensor: Matrix = [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
            let body = Body { moments, ..Body::new(mass, pose, &tensor) };
            sum = Some(match sum {
                None => body,
                Some(sum) => sum.with(&body, self.release.epsilon()),
            });
        }
        let least =
            solids.len() > 1 && sum.as_ref().is_some_and(|sum| sum.moments[2] < LEAST_EIGENVALUE);
        if least && name != "world" {
            return self.effects.refuse(link, Fault::MissingElement("inertial"));
        }
        Ok(sum.unwrap_or_default())
    }

    fn geom(&mut self, node: Node<'_>, part: &Part) -> Reading<(Solid, Pose)> {
        let geometry = self.needed(node, "geometry")?;
        let mut found = None;
        for name in ["box", "cylinder", "sphere", "capsule", "mesh"] {
            if found.is_none() {
                found = self.only(geometry, name)?;
            }
        }
        let Some(shape) = found else {
            return self.effects.shapeless(geometry);
        };
        let solid = match shape.name() {
            "box" => {
                let size = self.size(shape, "size")?;
                Solid::cuboid(size.iter().product(), size)
            }
            "sphere" => {
                let [radius] = self.size(shape, "radius")?;
                let volume = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
                Solid { volume, moments: [0.4 * radius * radius; 3] }
            }
            "mesh" => self.mesh(shape, part)?,
            _ => {
                let [radius] = self.size(shape, "radius")?;
                let [length] = self.size(shape, "length")?;
                let cap = if shape.name() == "capsule" { radius } else { 0.0 };
                let square = radius * radius;
                let across = (3.0 * square + (length + cap).powi(2)) / 12.0;
                let volume = std::f64::consts::PI * square * (length + 4.0 / 3.0 * cap);
                Solid { volume, moments: [across, across, square / 2.0] }
            }
        };
        if let Some(name) = node.attribute("name").filter(|name| !name.value.is_empty())
            && !self.geoms.insert(name.value.to_string())
        {
            let fault = Fault::not_unique("collision", &name.value);
            self.effects.read_as(name, part, fault, "without a name");
        }
        let pose = self.origin(node, part)?;
        Ok((solid, pose))
    }

    /// Sizes, which are above 0.
    fn size<const N: usize>(&mut self, shape: Node<'_>, name: &'static str) -> Reading<[f64; N]> {
        let sizes = self.needed_numbers(shape, name)?;
        match shape.attribute(name) {
            Some(value) if !sizes.iter().all(|size| *size > 0.0) => {
                self.effects.refuse(value, Fault::range(value, "must be above 0"))
            }
            _ => Ok(sizes),
        }
    }

    pub fn origin(&mut self, node: Node<'_>, part: &Part) -> Reading<Pose> {
        let Some(origin) = self.only(node, "origin")? else { return Ok(Pose::default()) };
        let part = part.inside("origin");
        let xyz = self.numbers(origin, "xyz", &part)?.unwrap_or_default();
        let rpy = self.numbers(origin, "rpy", &part)?.unwrap_or_default();
        if let Some(quaternion) = origin.attribute("quat_xyzw") {
            self.effects.unread(quaternion, part, "quat_xyzw");
        }
        Ok(Pose::new(xyz, rpy))
    }
}

/// Whether a body is too light to move.
pub fn is_light(body: &Body) -> bool {
    body.mass.is_nan() || body.mass < LEAST || body.moments.iter().any(|moment| *moment < LEAST)
}

/// The most triangles of an STL file.
const MAX_TRIANGLES: usize = 200_000;
const MAX_COORDINATE: f64 = (1 << 30) as f64;
const LEAST_VOLUME: f64 = 1e-15;

impl MujocoReader<'_> {
    pub fn mesh(&mut self, shape: Node<'_>, part: &Part) -> Reading<Solid> {
        let filename = self.effects.needed(shape, "filename")?;
        let scale = self.scale(shape)?;
        // What stands for a mesh that is not known, and for one that is refused.
        let any = Solid::cuboid(1e-3, [0.1; 3]);
        let facts = match self.facts(filename, part) {
            Ok(Some(facts)) => facts,
            Ok(None) => return Ok(any),
            Err(fault) => {
                self.effects.refuse_mendable(filename, fault);
                return Ok(any);
            }
        };
        let volume = facts.measures.volume * scale.iter().product::<f64>().abs();
        if let Some(why) = bad(&facts, volume, self.release) {
            self.effects.refuse_mendable(filename, Fault::Mesh(why));
            return Ok(any);
        }
        let size = [0, 1, 2].map(|axis| facts.measures.size[axis] * scale[axis]);
        // Without triangles the convex hull counts.
        let volume = match facts.triangles {
            0 => size.iter().product::<f64>().abs() / 6.0,
            _ => volume,
        };
        Ok(Solid::cuboid(volume, size))
    }

    /// What is in the file of a mesh, or why it is refused; none if that is not known.
    fn facts(
        &mut self,
        filename: &Attribute<'_>,
        part: &Part,
    ) -> Result<Option<Arc<MeshFacts>>, Fault> {
        let name = &*filename.value;
        if name.is_empty() {
            return Err(Fault::Empty("filename"));
        }
        let strips = self.settings.strips_paths.unwrap_or(self.release == Release::Three);
        if name.contains("://") && !strips {
            let why = "MuJoCo takes `scheme://` as a folder; write a path from the URDF's folder";
            return Err(Fault::ForOthers(why));
        }
        if !self.has_known_ending(name) {
            return Err(format_fault(name));
        }
        match self.found(filename, part, strips) {
            Mesh::Unknown | Mesh::NoPackage => Ok(None),
            Mesh::Found(facts) => Ok(Some(facts)),
            Mesh::Missing => {
                let is_moved = !self.settings.mesh_folder.is_empty()
                    && matches!(self.file.mesh(name), Mesh::Found(_));
                let what =
                    if is_moved { "mesh, in the folder of MuJoCo's `meshdir`," } else { "mesh" };
                Err(Fault::NotFound(what))
            }
        }
    }

    /// Whether a name ends as those of formats that it reads.
    fn has_known_ending(&self, name: &str) -> bool {
        let ending = last(name).rsplit_once('.').map_or("", |(_, ending)| ending);
        match self.release {
            Release::Four => ["stl", "STL", "obj", "OBJ", "msh"].contains(&ending),
            Release::Three => {
                ["stl", "obj", "msh"].iter().any(|known| ending.eq_ignore_ascii_case(known))
            }
        }
    }

    /// The file of a mesh. Where names lose their folders, a person has put the file beside the URDF.
    fn found(&mut self, filename: &Attribute<'_>, part: &Part, strips: bool) -> Mesh {
        let name = &*filename.value;
        let folder = &self.settings.mesh_folder;
        let within = |name: &str| match folder.is_empty() || name.starts_with('/') {
            true => self.file.mesh(name),
            false => self.file.mesh(&format!("{}/{name}", folder.trim_end_matches('/'))),
        };
        if !strips {
            return within(&name.replace('\\', "/"));
        }
        let beside = within(last(name));
        if !matches!(beside, Mesh::Missing) {
            return beside;
        }
        let there = match folder.is_empty() {
            true => self.file.mesh(name),
            false => Mesh::Missing,
        };
        if !matches!(there, Mesh::Missing) {
            let why = "the mesh is looked for beside the URDF, and its folders do not count";
            self.effects.read_as(filename, part, Fault::ForOthers(why), last(name));
        }
        there
    }
}

/// What is behind the last slash.
fn last(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Why a mesh is refused.
fn bad(facts: &MeshFacts, volume: f64, release: Release) -> Option<&'static str> {
    let measures = &facts.measures;
    if let Some(stl) = &facts.stl {
        match stl.binary {
            None => return Some("the mesh is no binary STL file"),
            Some(0) => return Some("the mesh has no triangle"),
            Some(count) if count > MAX_TRIANGLES => {
                return Some("the mesh has more than 200,000 triangles");
            }
            _ if measures.largest > MAX_COORDINATE => {
                return Some("the mesh has coordinates that are too large");
            }
            _ => {}
        }
    } else if let Some(obj) = &facts.obj {
        if obj.has_bad_index {
            return Some("the mesh has a face with a vertex that is not there");
        }
        if obj.lacks_normals && release == Release::Four {
            return Some("some faces of the mesh have normals, and others none");
        }
    } else {
        return Some("the mesh cannot be read");
    }
    if measures.has_infinite {
        Some("the mesh has a coordinate that is not finite")
    } else if measures.points < 4 {
        Some("the mesh has fewer than 4 vertices")
    } else if measures.spread[2] <= 1e-14 * measures.largest {
        Some("all vertices of the mesh are in one plane")
    } else if facts.triangles > 0 && volume < LEAST_VOLUME {
        Some("the volume of the mesh is too small")
    } else {
        None
    }
}
