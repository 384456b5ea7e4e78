//! Materials and links: the first part of a link that is faulty is lost, with all that is read after it.

use std::collections::BTreeMap;

use super::{Link, NO_COLOR, PartRead, UrdfdomReader, needed, needed_element, number, vector};
use crate::prelude::*;

impl UrdfdomReader<'_> {
    pub(super) fn materials(&mut self, robot: Node<'_>) -> Reading<()> {
        for material in robot.named("material") {
            let name = material.value("name").unwrap_or_default();
            let part = Part::of("material", name);
            if material.attribute("name").is_none() {
                self.effects.drop(material, part, Fault::Missing("name"));
            } else if !self.color(material, &part) {
                self.effects.read_as(material, part, Fault::Other(NO_COLOR), "black");
            }
            if self.materials.insert(name.to_owned(), Look::of(material)).is_some() {
                return self.effects.refuse(material, Fault::not_unique("material", name));
            }
        }
        Ok(())
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

    pub(super) fn links<'t>(&mut self, robot: Node<'t>) -> Reading<BTreeMap<&'t str, Link<'t>>> {
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

    pub(super) fn pose(&mut self, parent: Node<'_>) -> PartRead<()> {
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
