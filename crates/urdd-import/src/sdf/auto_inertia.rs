//! The mass of a link whose shapes have a density.

use std::f64::consts::PI;

use nalgebra::Vector3;

use super::super::features::Tally;
use super::super::mass::Mass;
use super::super::model::Inertial;
use super::super::refusal::Refusal;
use super::super::solid::{moments, volume};
use super::shape_reader::primitive;
use super::tag::Tag;

/// The density of what says none, kg/m³.
const WATER: f64 = 1000.0;

/// The mass of the collision shapes of a link; `None` without shapes that have one. A mass that is given scales it.
///
/// # Errors
/// If a number is none.
pub fn auto_inertia(
    link: Tag,
    inertial: Tag,
    tally: &mut Tally,
) -> Result<Option<Inertial>, Refusal> {
    let density = inertial.number("density")?.unwrap_or(WATER);
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
    let Some(whole) = Mass::together(&parts).filter(|whole| whole.mass > 0.0) else {
        return Ok(None);
    };
    let given = inertial.number("mass")?.filter(|given| *given > 0.0);
    let scale = given.map_or(1.0, |given| given / whole.mass);
    Ok(Some(Inertial {
        mass: whole.mass * scale,
        centre: whole.centre.into(),
        inertia: whole.inertia * scale,
        place: inertial.place(),
    }))
}

/// The mass of a shape; none of one whose density is not read.
fn part(shape: Tag, density: f64) -> Result<Option<Mass>, Refusal> {
    if shape.name() == "cone" {
        let (radius, length) = (shape.size("radius")?, shape.size("length")?);
        let mass = density * PI * radius * radius * length / 3.0;
        let across = mass * (3.0 / 20.0 * radius * radius + 3.0 / 80.0 * length * length);
        let centre = Vector3::new(0.0, 0.0, -length / 4.0);
        let moments = [across, across, mass * 0.3 * radius * radius];
        return Ok(Some(Mass::along_axes(mass, centre, moments)));
    }
    let Some(solid) = primitive(shape)? else { return Ok(None) };
    let mass = density * volume(&solid, false);
    Ok(Some(Mass::along_axes(mass, Vector3::zeros(), moments(&solid, false, mass))))
}
