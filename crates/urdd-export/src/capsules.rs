//! Capsules that a URDF has as a cylinder and a sphere on each of its ends.

use nalgebra::{Point3, Vector3};

use super::shapes::{Shape, Solid};
use urdd_geometry::primitives::Primitive;

/// How far a sphere may be from where it belongs, and its radius from that of the cylinder, in radii: what printing and
/// reading a URDF leaves.
const NEAR: f64 = 1e-6;

/// How far a sphere may be from its cylinder in the list of elements: a link may have many thousands.
const NEARBY: usize = 100;

/// Makes one capsule of each cylinder with a sphere of its radius on both ends, in any order.
pub(super) fn join(shapes: &mut Vec<Shape>) {
    let mut taken = vec![false; shapes.len()];
    for place in 0..shapes.len() {
        if let Some((ends, capsule)) = capsule(shapes, &taken, place) {
            ends.iter().for_each(|end| taken[*end] = true);
            shapes[place].solid = capsule;
        }
    }
    let mut taken = taken.into_iter();
    shapes.retain(|_| taken.next() != Some(true));
}

/// The places of the two spheres, and the capsule.
fn capsule(shapes: &[Shape], taken: &[bool], place: usize) -> Option<([usize; 2], Solid)> {
    let Solid::Primitive(pose, Primitive::Cylinder { radius, half }) = shapes[place].solid else {
        return None;
    };
    let near = place.saturating_sub(NEARBY)..shapes.len().min(place + NEARBY);
    let find = |z: f64| {
        let end = pose * Point3::from(Vector3::z() * z);
        near.clone().find(|other| match shapes[*other].solid {
            Solid::Primitive(at, Primitive::Sphere { radius: own }) if !taken[*other] => {
                let away = (at.translation.vector - end.coords).norm();
                away.max((own - radius).abs()) <= NEAR * radius
            }
            _ => false,
        })
    };
    let ends = [find(half)?, find(-half)?];
    let joined = Solid::Primitive(pose, Primitive::Capsule { radius, half });
    (ends[0] != ends[1]).then_some((ends, joined))
}
