//! Inertias that libsdformat adds up where links become one, and which of them ign-math calls valid.

use std::f64::consts::PI;

use crate::number::{Matrix, Pose, Vector, centre, moved, sum, transposed, turned};
use crate::prelude::*;

#[derive(Clone, Copy, Default)]
pub struct Inertia {
    pub mass: f64,
    pub pose: Pose,
    /// About the centre of mass, in the axes of its pose.
    pub moments: Matrix,
}

impl Inertia {
    /// Adds that of a link which is at a pose. If both have no mass, the centre of mass is not a number.
    pub fn add(&mut self, other: &Inertia, at: &Pose) {
        let placed = at.then(&other.pose);
        let common = centre([self.mass, other.mass], [self.pose.xyz, placed.xyz]);
        let first = turned(&self.moments, &self.pose.turn);
        let first = moved(&first, self.mass, self.pose.xyz, common);
        let second = turned(&other.moments, &placed.turn);
        let second = moved(&second, other.mass, placed.xyz, common);
        self.moments = turned(&sum(&first, &second), &transposed(&self.pose.turn));
        self.pose.xyz = common;
        self.mass += other.mass;
    }

    /// `MassMatrix3::IsValid` of ign-math.
    pub fn is_valid(&self) -> bool {
        let m = &self.moments;
        let diagonal = [m[0][0], m[1][1], m[2][2]];
        let near = tolerance(diagonal);
        let determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2])
            - m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2])
            + m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
        let minor = m[0][0] * m[1][1] - m[0][1] * m[0][1];
        let is_positive = self.mass >= 0.0
            && [m[0][0], minor, determinant].into_iter().all(|number| number + near >= 0.0);
        let principal = self.principal();
        let near = tolerance(principal);
        let [a, b, c] = principal;
        is_positive
            && principal.into_iter().all(|moment| moment + near >= 0.0)
            && [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(a, b, c)| a + b + near >= c)
    }

    /// The principal moments, as ign-math finds them.
    fn principal(&self) -> Vector {
        const NEAR: f64 = 1e-6;
        let m = &self.moments;
        let (x, y, z) = (m[0][0], m[1][1], m[2][2]);
        let (xy, xz, yz) = (m[0][1], m[0][2], m[1][2]);
        let near = NEAR * x.max(y).max(z);
        if [xy, xz, yz].into_iter().all(|product| product.abs() <= near) {
            return [x, y, z];
        }
        let b = x + y + z;
        let c = x * y - xy * xy + x * z - xz * xz + y * z - yz * yz;
        let d = x * yz * yz + y * xz * xz + z * xy * xy - x * y * z - 2.0 * xy * xz * yz;
        let p = b * b - 3.0 * c;
        if p < near * near {
            return [b / 3.0; 3];
        }
        let q = 2.0 * b * b * b - 9.0 * b * c - 27.0 * d;
        let angle = (0.5 * q / p.powf(1.5)).clamp(-1.0, 1.0).acos();
        [0.0, 2.0 * PI, -2.0 * PI]
            .map(|turn| (b + 2.0 * p.sqrt() * ((angle + turn) / 3.0).cos()) / 3.0)
    }
}

/// What counts as nothing beside moments.
fn tolerance(moments: Vector) -> f64 {
    10.0 * f64::EPSILON * 0.5 * moments.iter().sum::<f64>().abs()
}

/// The inertia that urdfdom has of a link; without mass if it is faulty.
pub fn inertia_of(link: Node<'_>) -> Option<Inertia> {
    let inertial = link.child("inertial")?;
    let of = |element: &str, name: &str| number(inertial.child(element)?.value(name)?);
    let mut found = Inertia::default();
    let (Some(pose), Some(mass)) = (pose(inertial), of("mass", "value")) else {
        return Some(found);
    };
    (found.pose, found.mass) = (pose, mass);
    let all = MOMENTS.map(|name| of("inertia", name));
    if let [Some(xx), Some(xy), Some(xz), Some(yy), Some(yz), Some(zz)] = all {
        found.moments = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    }
    Some(found)
}

/// The pose of an element, if it has no fault.
pub fn pose(parent: Node<'_>) -> Option<Pose> {
    let Some(origin) = parent.child("origin") else { return Some(Pose::default()) };
    let read = |value: Option<&Attribute<'_>>| match value {
        Some(value) => vector(&value.value),
        None => Some(Vector::default()),
    };
    Some(Pose::new(read(origin.attribute("xyz"))?, read(origin.attribute("rpy"))?))
}

pub fn number(text: &str) -> Option<f64> {
    whole(istream(text))
}

pub fn vector(text: &str) -> Option<Vector> {
    let numbers: Option<Vec<f64>> = pieces(text).map(number).collect();
    numbers?.try_into().ok()
}
