//! Links: inertials, visuals and collisions.

use super::inertia::{Body, LEAST_EIGENVALUE, eigenvalues};
use super::reader::{LEAST, MujocoReader, Release};
use crate::prelude::*;
use crate::space::{Matrix, Pose};

/// The density of collisions, kg per cubic metre.
const DENSITY: f64 = 1000.0;
/// A collision of less mass adds nothing.
const LEAST_GEOM: f64 = 1e-14;

/// What of a shape counts for its inertia: volume, and the moments of 1 kg about its own axes.
pub(super) struct Solid {
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
        let own = match self.only(link, "inertial")? {
            Some(inertial) => Some(self.inertial(inertial, name)?),
            None => None,
        };
        let mut solids = Vec::new();
        for (visual, part) in part.shapes(link, "visual") {
            self.own_material(visual)?;
            match self.settings.has_visuals {
                true => solids.push(self.geom(visual, &part)?),
                false => self.effects.unread(visual, part, "visual"),
            }
        }
        for (collision, part) in part.shapes(link, "collision") {
            solids.push(self.geom(collision, &part)?);
        }
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
        let mut pose = self.origin(inertial, &part)?;
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
            [*value] = self.needed_numbers(node, name)?;
        }
        if kilograms < 0.0 || kilograms.is_nan() {
            let fault = Fault::Inertia("a mass that is not above 0 is 0");
            self.effects.read_as(mass, &part, fault, "0");
        }
        let kilograms = if kilograms < 0.0 { 0.0 } else { kilograms };
        let moments = self.moments(node, six, name)?;
        let [ixx, iyy, izz, ixy, ixz, iyz] = six;
        let tensor = match moments {
            [0.0, 0.0, 0.0] => [[0.0; 3]; 3],
            _ => [[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]],
        };
        Ok(Body { moments, ..Body::new(kilograms, &pose, &tensor) })
    }

    /// The eigenvalues of a tensor. A tensor of zeros is none.
    fn moments(&mut self, node: Node<'_>, six: [f64; 6], name: &str) -> Reading<[f64; 3]> {
        let [ixx, iyy, izz, ixy, ixz, iyz] = six;
        if six == [0.0; 6] {
            return Ok([0.0; 3]);
        }
        if six.iter().any(|value| !value.is_finite()) {
            let fault = Fault::Inertia("a number of it is not finite");
            self.effects.read_as(node, Part::of("link", name).inside("inertial"), fault, "0");
            return Ok([0.0; 3]);
        }
        let moments = eigenvalues(
            &[[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]],
            self.release.epsilon(),
        );
        let is_bound = self.release == Release::Four && self.settings.least[1] > 0.0;
        if moments[2] < LEAST_EIGENVALUE && !is_bound {
            let fault = Fault::Inertia("the inertia has an eigenvalue that is not above 0");
            return self.effects.refuse(node, fault);
        }
        if moments[2] + moments[1] < moments[0] && name != "world" {
            if self.settings.balances {
                return Ok([moments.iter().sum::<f64>() / 3.0; 3]);
            }
            let why = "a moment of inertia is above the sum of the other two";
            return self.effects.refuse(node, Fault::Inertia(why));
        }
        Ok(moments)
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
pub(super) fn is_light(body: &Body) -> bool {
    body.mass.is_nan() || body.mass < LEAST || body.moments.iter().any(|moment| *moment < LEAST)
}
