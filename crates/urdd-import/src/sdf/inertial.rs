//! Reads the mass of a link.

use nalgebra::{Isometry3, Matrix3, Point3};

use super::super::features::{self, Tally};
use super::super::model::Inertial;
use super::super::refusal::Refusal;
use super::auto_inertia::auto_inertia;
use super::libsdformat::{REFUSED, takes_mass};
use super::tag::Tag;

/// The places of an inertia, by name.
const PLACES: [(&str, usize, usize); 6] =
    [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)];

/// Reads the mass of a link. What it does not say is 1 kg and 1 kg m², as SDF has it.
///
/// # Errors
/// If a number is none.
pub fn inertial(link: Tag, tally: &mut Tally) -> Result<Inertial, Refusal> {
    let Some(tag) = link.child("inertial") else {
        tally.count(features::DEFAULT_MASSES);
        return Ok(Inertial {
            mass: 1.0,
            centre: Point3::origin(),
            inertia: Matrix3::identity(),
            place: link.place(),
        });
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
    Ok(turned(mass.unwrap_or(1.0), &own, &pose, tag))
}

/// A mass whose inertia is along the axes of its own frame.
fn turned(mass: f64, own: &Matrix3<f64>, pose: &Isometry3<f64>, tag: Tag) -> Inertial {
    let centre = pose.translation.vector.into();
    let inertia = if pose.rotation.angle() == 0.0 {
        *own
    } else {
        let rotation = pose.rotation.to_rotation_matrix();
        let turned = rotation.matrix() * own * rotation.matrix().transpose();
        (turned + turned.transpose()) / 2.0
    };
    Inertial { mass, centre, inertia, place: tag.place() }
}
