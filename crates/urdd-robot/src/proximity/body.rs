//! Shapes prepared for distance queries, and their bounding spheres.

use crate::shapes::Solid;
use urdd_geometry::bounding_sphere::{BoundingSphere, about, about_spheres};
use urdd_geometry::convex::{ConvexShape, ShapeError};
use urdd_geometry::oriented_box::corners;

/// A shape prepared for distance queries.
#[derive(Debug)]
pub(crate) enum Body {
    /// A hull, a piece, or the corners of a box.
    Convex(ConvexShape),
    /// A sphere, as its centre. Its bounding sphere has the radius.
    Round(ConvexShape),
}

/// A shape with its bounding sphere.
#[derive(Debug)]
pub(crate) struct Shape {
    pub link: usize,
    pub piece: usize,
    pub body: Body,
    pub sphere: BoundingSphere,
}

/// Prepares a shape, and computes its bounding sphere.
pub(super) fn body(solid: &Solid) -> Result<(Body, BoundingSphere), ShapeError> {
    let of_points = |points: &[[f64; 3]]| {
        let shape = ConvexShape::of_points(points)?;
        let sphere = about(shape.centre(), points);
        Ok((Body::Convex(shape), sphere))
    };
    match solid {
        Solid::Mesh(mesh) => of_points(&mesh.vertices),
        Solid::Box { pose, half_extents } => {
            let placed = |p: [f64; 3]| (pose * nalgebra::Point3::from(p)).coords.into();
            of_points(&corners(*half_extents).map(placed))
        }
        Solid::Sphere { centre, radius } => {
            let (centre, radius) = (*centre, *radius);
            // The same limits as for points.
            ConvexShape::of_points(&[centre, centre.map(|x| x + radius)])?;
            let core = ConvexShape::of_points(&[centre])?;
            Ok((Body::Round(core), BoundingSphere { centre, radius }))
        }
    }
}

/// A bounding sphere of all shapes of a link; `None` if it has none.
pub(super) fn about_link(shapes: &[Shape], link: usize) -> Option<BoundingSphere> {
    let own = shapes.iter().filter(|shape| shape.link == link);
    about_spheres(own.map(|shape| &shape.sphere))
}
