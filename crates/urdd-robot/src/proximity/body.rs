//! Shapes prepared for distance queries, and their bounding spheres.

use super::vector::dot;
use crate::shapes::Solid;
use urdd_geometry::convex::{ConvexShape, ShapeError};

/// A shape prepared for distance queries.
#[derive(Debug)]
pub(crate) enum Body {
    /// A hull, a piece, or the corners of a box.
    Convex(ConvexShape),
    /// A sphere, as its centre. Its bounding sphere has the radius.
    Round(ConvexShape),
}

/// A sphere in a link's frame, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    pub centre: [f64; 3],
    pub radius: f64,
}

/// A shape with its bounding sphere.
#[derive(Debug)]
pub(crate) struct Shape {
    pub link: usize,
    pub piece: usize,
    pub body: Body,
    pub sphere: Sphere,
}

/// Relative margin of a bounding sphere's radius, larger than any rounding error.
const MARGIN: f64 = 1e-12;

/// Prepares a shape, and computes its bounding sphere.
pub(super) fn body(solid: &Solid) -> Result<(Body, Sphere), ShapeError> {
    let of_points = |points: &[[f64; 3]]| {
        let shape = ConvexShape::of_points(points)?;
        let sphere = around(shape.centre(), points);
        Ok((Body::Convex(shape), sphere))
    };
    match solid {
        Solid::Mesh(mesh) => of_points(&mesh.vertices),
        Solid::Box { pose, half_extents } => {
            let corner = |i: usize| {
                let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
                let at = [0, 1, 2].map(|k| sign(k) * half_extents[k]);
                (pose * nalgebra::Point3::from(at)).coords.into()
            };
            let corners: [[f64; 3]; 8] = std::array::from_fn(corner);
            of_points(&corners)
        }
        Solid::Sphere { centre, radius } => {
            let (centre, radius) = (*centre, *radius);
            // The same limits as for points.
            ConvexShape::of_points(&[centre, centre.map(|x| x + radius)])?;
            let core = ConvexShape::of_points(&[centre])?;
            Ok((Body::Round(core), Sphere { centre, radius }))
        }
    }
}

fn around(centre: [f64; 3], points: &[[f64; 3]]) -> Sphere {
    let away = |p: &[f64; 3]| {
        let offset = [0, 1, 2].map(|k| p[k] - centre[k]);
        dot(offset, offset)
    };
    let radius = points.iter().map(away).fold(0.0, f64::max).sqrt();
    Sphere {
        centre,
        radius: radius * (1.0 + MARGIN) + f64::MIN_POSITIVE,
    }
}

/// A bounding sphere of all shapes of a link; `None` if it has none.
pub(super) fn about(shapes: &[Shape], link: usize) -> Option<Sphere> {
    let own = || {
        shapes
            .iter()
            .filter(|shape| shape.link == link)
            .map(|shape| &shape.sphere)
    };
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for sphere in own() {
        for k in 0..3 {
            low[k] = low[k].min(sphere.centre[k] - sphere.radius);
            high[k] = high[k].max(sphere.centre[k] + sphere.radius);
        }
    }
    own().next()?;
    let centre = [0, 1, 2].map(|k| 0.5 * (low[k] + high[k]));
    let reach = |sphere: &Sphere| {
        let offset = [0, 1, 2].map(|k| sphere.centre[k] - centre[k]);
        dot(offset, offset).sqrt() + sphere.radius
    };
    let radius = own().map(reach).fold(0.0, f64::max);
    Some(Sphere {
        centre,
        radius: radius * (1.0 + MARGIN),
    })
}
