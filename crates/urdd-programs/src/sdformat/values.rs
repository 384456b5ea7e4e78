//! Values as urdfdom has them.

use super::inertia::{Inertia, Pose, Vector};
use crate::number::{istream, pieces, whole};
use crate::tree::{Attribute, Node};

/// The inertia that urdfdom has of a link; without mass if it is faulty.
pub(super) fn inertia_of(link: Node<'_>) -> Option<Inertia> {
    let inertial = link.child("inertial")?;
    let of = |element: &str, name: &str| number(inertial.child(element)?.value(name)?);
    let mut found = Inertia::default();
    let (Some(pose), Some(mass)) = (pose(inertial), of("mass", "value")) else {
        return Some(found);
    };
    (found.pose, found.mass) = (pose, mass);
    let all = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(|name| of("inertia", name));
    if let [Some(xx), Some(xy), Some(xz), Some(yy), Some(yz), Some(zz)] = all {
        found.moments = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    }
    Some(found)
}

/// The pose of an element, if it has no fault.
pub(super) fn pose(parent: Node<'_>) -> Option<Pose> {
    let Some(origin) = parent.child("origin") else { return Some(Pose::default()) };
    let read = |value: Option<&Attribute<'_>>| match value {
        Some(value) => vector(&value.value),
        None => Some(Vector::default()),
    };
    Some(Pose { xyz: read(origin.attribute("xyz"))?, rpy: read(origin.attribute("rpy"))? })
}

pub(super) fn number(text: &str) -> Option<f64> {
    whole(istream(text))
}

pub(super) fn vector(text: &str) -> Option<Vector> {
    let numbers: Option<Vec<f64>> = pieces(text).map(number).collect();
    numbers?.try_into().ok()
}
