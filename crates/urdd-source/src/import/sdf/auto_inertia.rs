//! The mass of a link whose shapes have a density.

use std::f64::consts::PI;

use nalgebra::{Isometry3, Matrix3, Vector3};

use super::super::features::Tally;
use super::super::model::Inertial;
use super::refusal::Refusal;
use super::tag::Tag;

/// The density of what says none, kg/m³.
const WATER: f64 = 1000.0;

/// A solid about the centre of its mass.
struct Solid {
    volume: f64,
    /// The inertia of a mass of 1.
    unit: Vector3<f64>,
    /// The centre of its mass in the frame of the shape.
    centre: Vector3<f64>,
}

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
    let mut parts: Vec<(f64, Isometry3<f64>, Solid)> = Vec::new();
    for collision in link.children().filter(|child| child.name() == "collision") {
        let Some(geometry) = collision.child("geometry") else { continue };
        let Some(shape) = geometry.children().next() else { continue };
        let Some(solid) = solid(shape)? else {
            let text = format!("`<{}>` gives no mass: its density is not read", shape.name());
            tally.remark(shape.place(), text);
            continue;
        };
        let density = collision.number("density")?.unwrap_or(density);
        let (pose, relative_to) = collision.pose()?;
        if relative_to.is_some() {
            let text = "the pose of this shape is taken as one in the link's frame, for its mass";
            tally.remark(collision.place(), text);
        }
        parts.push((density * solid.volume, pose, solid));
    }
    let mass: f64 = parts.iter().map(|(mass, ..)| mass).sum();
    if mass <= 0.0 {
        return Ok(None);
    }
    let centre_of = |(mass, pose, solid): &(f64, Isometry3<f64>, Solid)| {
        (pose * nalgebra::Point3::from(solid.centre)).coords * *mass
    };
    let centre: Vector3<f64> = parts.iter().map(centre_of).sum::<Vector3<f64>>() / mass;
    let mut inertia = Matrix3::zeros();
    for (mass, pose, solid) in &parts {
        let rotation = pose.rotation.to_rotation_matrix();
        let own = rotation.matrix() * Matrix3::from_diagonal(&(solid.unit * *mass));
        let offset = (pose * nalgebra::Point3::from(solid.centre)).coords - centre;
        let apart = Matrix3::identity() * offset.norm_squared() - offset * offset.transpose();
        inertia += own * rotation.matrix().transpose() + apart * *mass;
    }
    let given = inertial.number("mass")?.filter(|given| *given > 0.0);
    let scale = given.map_or(1.0, |given| given / mass);
    Ok(Some(Inertial {
        mass: mass * scale,
        centre: centre.into(),
        inertia: inertia * scale,
        place: inertial.place(),
    }))
}

/// A shape as a solid.
fn solid(shape: Tag) -> Result<Option<Solid>, Refusal> {
    let mut centre = Vector3::zeros();
    let round = |x: f64, z: f64| Vector3::new(x, x, z);
    let (volume, unit) = match shape.name() {
        "box" => {
            let size = shape.vector("size")?.unwrap_or(Vector3::repeat(1.0));
            let square = size.component_mul(&size);
            (size.product(), Vector3::repeat(square.sum() / 12.0) - square / 12.0)
        }
        "sphere" => {
            let radius = shape.size("radius")?;
            (4.0 / 3.0 * PI * radius.powi(3), Vector3::repeat(0.4 * radius * radius))
        }
        "ellipsoid" => {
            let radii = shape.vector("radii")?.unwrap_or(Vector3::repeat(1.0));
            let square = radii.component_mul(&radii);
            (4.0 / 3.0 * PI * radii.product(), (Vector3::repeat(square.sum()) - square) / 5.0)
        }
        "cylinder" => {
            let (radius, length) = (shape.size("radius")?, shape.size("length")?);
            let square = radius * radius;
            (PI * square * length, round(square / 4.0 + length * length / 12.0, square / 2.0))
        }
        "cone" => {
            let (radius, length) = (shape.size("radius")?, shape.size("length")?);
            let square = radius * radius;
            centre.z = -length / 4.0;
            let across = 3.0 / 20.0 * square + 3.0 / 80.0 * length * length;
            (PI * square * length / 3.0, round(across, 0.3 * square))
        }
        "capsule" => {
            let (radius, length) = (shape.size("radius")?, shape.size("length")?);
            let square = radius * radius;
            let (tube, ball) = (PI * square * length, 4.0 / 3.0 * PI * square * radius);
            let volume = tube + ball;
            // Half a ball is 3/8 of a radius away from its flat side.
            let end = 0.4 * square + length * length / 4.0 + 3.0 / 8.0 * length * radius;
            let across = tube * (square / 4.0 + length * length / 12.0) + ball * end;
            let along = tube * square / 2.0 + ball * 0.4 * square;
            (volume, round(across / volume, along / volume))
        }
        _ => return Ok(None),
    };
    Ok(Some(Solid { volume, unit, centre }))
}
