//! Reads the mass of a link.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Point3};

use super::super::features::{self, Tally};
use super::super::mass::{WATER, turned};
use super::super::model::Inertial;
use super::super::refusal::Fallible;
use super::libsdformat::{REFUSED, takes_mass};
use super::shape_reader::primitive;
use super::tag::Tag;

/// The places of an inertia, by name.
const PLACES: [(&str, usize, usize); 6] =
    [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)];

/// Reads the mass of a link. What it does not say is 1 kg and 1 kg m², as SDF has it.
pub fn inertial(link: Tag, tally: &mut Tally) -> Fallible<Inertial> {
    let Some(tag) = link.child("inertial") else {
        tally.count(features::DEFAULT_MASSES);
        return Ok(Inertial::along_axes(1.0, [1.0; 3]));
    };
    let known = ["pose", "mass", "inertia", "density", "auto_inertia_params"];
    tag.unread(&known, tally);
    if tag.says("auto") {
        if let Some(inertial) = auto_inertia(link, tag, tally)? {
            tally.count(features::AUTO_MASSES);
            return Ok(inertial);
        }
        tally.remark(
            tag.place(),
            "the mass follows from shapes, and no shape here gives one: it is read as it is given",
        );
    }
    let (pose, _) = tag.pose()?;
    let mass = tag.number("mass")?;
    let mut own = Matrix3::identity();
    let mut is_given = mass.is_some();
    if let Some(inertia) = tag.child("inertia") {
        for (name, row, column) in PLACES {
            let value = inertia.number(name)?;
            is_given &= value.is_some() || row != column;
            if let Some(value) = value {
                own[(row, column)] = value;
                own[(column, row)] = value;
            }
        }
    } else {
        is_given = false;
    }
    if !takes_mass(mass.unwrap_or(1.0), &own) {
        let text = format!("{REFUSED}no body has such a mass and such moments of inertia");
        tally.remark(tag.place(), text);
    }
    tally.count(if is_given { features::MASSES } else { features::DEFAULT_MASSES });
    Ok(placed(mass.unwrap_or(1.0), &own, &pose))
}

/// A mass whose inertia is along the axes of its own frame.
fn placed(mass: f64, own: &Matrix3<f64>, pose: &Isometry3<f64>) -> Inertial {
    let inertia = if pose.rotation.angle() == 0.0 {
        *own
    } else {
        let turned = turned(own, &pose.rotation);
        (turned + turned.transpose()) / 2.0
    };
    Inertial { mass, centre: pose.translation.vector.into(), inertia }
}

/// The mass of the collision shapes of a link; `None` without shapes that have one. A mass that is given scales it.
fn auto_inertia(link: Tag, tag: Tag, tally: &mut Tally) -> Fallible<Option<Inertial>> {
    let density = tag.number("density")?.unwrap_or(WATER);
    let mut parts = Vec::new();
    for collision in link.children().filter(|child| child.name() == "collision") {
        let Some(geometry) = collision.child("geometry") else { continue };
        let Some(shape) = geometry.children().next() else { continue };
        let own = collision.number("density")?.unwrap_or(density);
        let Some(part) = part(shape, own)? else {
            let text = format!("`<{}>` gives no mass: its density is not read", shape.name());
            tally.remark(shape.place(), text);
            continue;
        };
        let (pose, relative_to) = collision.pose()?;
        if relative_to.is_some() {
            let text = "the pose of this shape is taken as one in the link's frame, for its mass";
            tally.remark(collision.place(), text);
        }
        parts.push(part.at(&pose));
    }
    let whole = Inertial::together(&parts).filter(|whole| whole.mass > 0.0);
    let Some(Inertial { mass, centre, inertia }) = whole else { return Ok(None) };
    let given = tag.number("mass")?.filter(|given| *given > 0.0);
    let scale = given.map_or(1.0, |given| given / mass);
    Ok(Some(Inertial { mass: mass * scale, centre, inertia: inertia * scale }))
}

/// The mass of a shape; none of one whose density is not read.
fn part(shape: Tag, density: f64) -> Fallible<Option<Inertial>> {
    if shape.name() == "cone" {
        let (radius, length) = (shape.size("radius")?, shape.size("length")?);
        let mass = density * PI * radius * radius * length / 3.0;
        let across = mass * (3.0 / 20.0 * radius * radius + 3.0 / 80.0 * length * length);
        let centre = Point3::new(0.0, 0.0, -length / 4.0);
        let moments = [across, across, mass * 0.3 * radius * radius];
        return Ok(Some(Inertial { centre, ..Inertial::along_axes(mass, moments) }));
    }
    let solid = primitive(shape)?;
    Ok(solid.map(|solid| Inertial::of_primitive(&solid, false, density)))
}
