//! Materials and links: the first part of a link that is faulty is lost, with all that is read after it. Joints: any fault in one
//! refuses the file.

use std::collections::BTreeMap;

use crate::prelude::*;
use crate::urdfdom::{
    Joint, Link, NO_COLOR, PartRead, UrdfdomReader, needed, needed_element, number, numbers, vector,
};

impl UrdfdomReader<'_> {
    pub fn materials(&mut self, robot: Node<'_>) {
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            let part = Part::of("material", name);
            if material.attribute("name").is_none() {
                self.effects.drop(material, part, Fault::Missing("name"));
            } else if !self.color(material, &part) {
                self.effects.read_as(material, part, Fault::Other(NO_COLOR), "black");
            }
            if self.materials.insert(name.to_owned(), Look::of(material)).is_some() {
                self.effects.refuse_mendable(material, Fault::not_unique("material", name));
                // Which of them is meant is not known.
                self.materials.insert(name.to_owned(), None);
            }
        }
    }

    /// Whether a material has a colour or a texture.
    fn color(&mut self, material: Node<'_>, part: &Part) -> bool {
        let texture = material.child("texture").and_then(|node| node.attribute("filename"));
        if let Some(empty) = texture.filter(|filename| filename.value.is_empty()) {
            self.effects.drop(empty, part, Fault::Empty("filename"));
        }
        let texture = texture.is_some();
        let color = material.child("color").and_then(|node| node.attribute("rgba"));
        let Some(rgba) = color else { return texture };
        let numbers =
            pieces(&rgba.value).map(|piece| whole(istream(piece))).collect::<Option<Vec<f64>>>();
        let (fault, has_look) = match numbers {
            None => (Fault::not_a_number(rgba), texture),
            Some(numbers) if numbers.iter().any(|number| !(0.0..=1.0).contains(number)) => {
                (Fault::range(rgba, COLOR_RULE), texture)
            }
            Some(numbers) if numbers.len() != 4 => (Fault::count(rgba, 4), true),
            Some(_) => return true,
        };
        self.effects.read_as(rgba, part, fault, "black");
        has_look
    }

    pub fn links<'t>(&mut self, robot: Node<'t>) -> Reading<BTreeMap<&'t str, Link<'t>>> {
        let mut links = BTreeMap::new();
        for node in robot.named("link") {
            let name = node.value("name").unwrap_or_default();
            let kept = match node.attribute("name") {
                Some(_) => self.link(node, name),
                None => {
                    self.effects.drop(node, Part::of("link", name), Fault::Missing("name"));
                    [(0, true); 2]
                }
            };
            if links.insert(name, Link { node, kept }).is_some() {
                self.effects.refuse_mendable(node, Fault::not_unique("link", name));
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
            let part = Part::of("link", name).inside("inertial");
            if let Err((at, fault)) = self.inertial(inertial) {
                self.effects.drop(at, part, fault.clone());
                bad = Some((at, fault));
            }
        }
        let mut kept = [(0, true); 2];
        for (kind, kept) in ["visual", "collision"].into_iter().zip(&mut kept) {
            for (node, part) in Part::of("link", name).shapes(link, kind) {
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

    fn inertial(&mut self, inertial: Node<'_>) -> PartRead<()> {
        self.pose(inertial)?;
        let mass = needed_element(inertial, "mass")?;
        number(needed(mass, "value")?)?;
        let inertia = needed_element(inertial, "inertia")?;
        for name in MOMENTS {
            number(needed(inertia, name)?)?;
        }
        Ok(())
    }

    /// A visual or collision.
    fn shape(&mut self, shape: Node<'_>, part: &Part) -> PartRead<()> {
        self.pose(shape)?;
        let geometry = needed_element(shape, "geometry")?;
        self.geometry(geometry)?;
        let Some(material) = shape.child("material").filter(|_| shape.name() == "visual") else {
            return Ok(());
        };
        let name = &*needed(material, "name")?.value;
        let part = part.inside("material");
        if let Some(first) = self.materials.get(name).filter(|_| !name.is_empty()) {
            Look::compare(first.as_ref(), material, &part, self.effects);
        } else {
            let is_defined = self.color(material, &part);
            if is_defined && !name.is_empty() {
                self.materials.insert(name.to_owned(), Look::of(material));
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

    fn geometry(&mut self, geometry: Node<'_>) -> PartRead<()> {
        let Some(form) = geometry.children().next() else {
            return Err((geometry.start(), NO_SHAPE));
        };
        let sizes: &[&'static str] = match form.name() {
            "sphere" => &["radius"],
            "cylinder" => &["length", "radius"],
            "capsule" if self.minor > 0 => &["length", "radius"],
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
            other => return Err((form.start(), Fault::Shape(other.into()))),
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

    fn positive(&self, size: &Attribute<'_>, values: &[f64]) -> PartRead<()> {
        match self.minor >= 2 && !values.iter().all(|value| *value > 0.0) {
            true => Err((size.at(), Fault::range(size, "URDF 1.2 has only sizes above 0"))),
            false => Ok(()),
        }
    }

    pub fn pose(&mut self, parent: Node<'_>) -> PartRead<()> {
        let Some(origin) = parent.child("origin") else { return Ok(()) };
        if let Some(xyz) = origin.attribute("xyz") {
            vector(xyz, 3)?;
        }
        let (rpy, quaternion) = (origin.attribute("rpy"), origin.attribute("quat_xyzw"));
        if let (Some(_), Some(second)) = (rpy, quaternion)
            && self.minor > 0
        {
            return Err((second.at(), Fault::Other("`<origin>` has both `rpy` and `quat_xyzw`")));
        }
        if let Some(rpy) = rpy {
            vector(rpy, 3)?;
        }
        match quaternion {
            Some(quaternion) if self.minor > 0 => vector(quaternion, 4).map(|_| ()),
            _ => Ok(()),
        }
    }
}

impl UrdfdomReader<'_> {
    /// The joints. One that is refused has its ends nevertheless.
    pub fn joints<'t>(&mut self, robot: Node<'t>) -> BTreeMap<&'t str, Joint<'t>> {
        let mut joints = BTreeMap::new();
        for node in robot.named("joint") {
            let kind = self.joint(node).unwrap_or_else(|(at, fault)| {
                self.effects.refuse_mendable(at, fault);
                ""
            });
            let end = |name| node.child(name).and_then(|end| end.value("link")).unwrap_or_default();
            let name = node.value("name").unwrap_or_default();
            let joint = Joint { node, kind, parent: end("parent"), child: end("child") };
            if joints.insert(name, joint).is_some() {
                let _ = self.effects.refuse::<()>(node, Fault::not_unique("joint", name));
            }
        }
        joints
    }

    /// The type of a joint.
    fn joint<'t>(&mut self, node: Node<'t>) -> PartRead<&'t str> {
        let name = &*needed(node, "name")?.value;
        self.pose(node)?;
        let kind = needed(node, "type")?;
        if !JOINT_TYPES.contains(&&*kind.value) {
            return Err((kind.range.start, Fault::value("type", &kind.value)));
        }
        if let Some(axis) =
            node.child("axis").filter(|_| !matches!(&*kind.value, "fixed" | "floating"))
        {
            match axis.attribute("xyz") {
                Some(xyz) => drop(vector(xyz, 3)?),
                None => {
                    let part = Part::of("joint", name).inside("axis");
                    self.effects.read_as(axis, part, Fault::Missing("xyz"), "0 0 0");
                }
            }
        }
        let is_limited = matches!(&*kind.value, "revolute" | "prismatic");
        match node.child("limit") {
            Some(limit) => {
                self.limit(limit, is_limited, &Part::of("joint", name).inside("limit"))?
            }
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
                return Err((dynamics.start(), NO_DYNAMICS));
            }
            numbers(dynamics, &["damping", "friction"])?;
        }
        Ok(&kind.value)
    }

    fn limit(&mut self, limit: Node<'_>, is_limited: bool, part: &Part) -> PartRead<()> {
        numbers(limit, &["lower", "upper"])?;
        if self.minor < 2 {
            for name in ["effort", "velocity"] {
                number(needed(limit, name)?)?;
            }
            self.effects.unread_attributes(limit, FURTHER, part);
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
            return Err((limit.start(), CROSSED));
        }
        let names = ["effort", "velocity"].into_iter().chain(FURTHER.split(' '));
        for value in names.filter_map(|name| limit.attribute(name)) {
            if number(value)? < 0.0 {
                return Err((value.at(), Fault::range(value, "must not be negative")));
            }
        }
        Ok(())
    }
}
