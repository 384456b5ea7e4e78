//! Shapes prepared for distance queries, their bounding spheres, and poses as arrays.

use std::sync::Arc;

use crate::kept::Solid;
use urdd_geometry::bounding_sphere::{BoundingSphere, about, about_spheres};
use urdd_geometry::convex::{ConvexShape, ShapeError};
use urdd_geometry::oriented_box::corners;
use urdd_geometry::vector::{dot, sub};

/// A shape prepared for distance queries, with its bounding sphere.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    pub link: usize,
    /// Whose it is: the link, or, from the number of links on, an attached object.
    pub owner: usize,
    pub piece: usize,
    /// A hull, a piece, the corners of a box, or the centre of a ball. Shared with those who attach objects.
    pub core: Arc<ConvexShape>,
    /// The shape is all points that are at most this far from `core`, m.
    pub radius: f64,
    pub sphere: BoundingSphere,
    /// Whether its bounding sphere is the shape itself.
    pub is_ball: bool,
}

impl Shape {
    /// A shape of a link.
    pub fn of(link: usize, piece: usize, solid: &Solid) -> Result<Self, ShapeError> {
        let shape = |core, sphere: BoundingSphere, is_ball| Shape {
            link,
            owner: link,
            piece,
            core: Arc::new(core),
            radius: if is_ball { sphere.radius } else { 0.0 },
            sphere,
            is_ball,
        };
        let of_points = |points: &[[f64; 3]]| {
            let core = ConvexShape::of_points(points)?;
            let sphere = about(core.centre(), points);
            Ok(shape(core, sphere, false))
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
                Ok(shape(core, BoundingSphere { centre, radius }, true))
            }
        }
    }
}

/// A bounding sphere of all shapes of a link; `None` if it has none.
pub(super) fn about_link(shapes: &[Shape], link: usize) -> Option<BoundingSphere> {
    let own = shapes.iter().filter(|shape| shape.link == link);
    about_spheres(own.map(|shape| &shape.sphere))
}

/// Transforms a point from a link's frame to the root link's frame.
pub(crate) fn to_root(link: &[[f64; 3]; 4], p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| link[0][k] * p[0] + link[1][k] * p[1] + link[2][k] * p[2] + link[3][k])
}

/// The pose of frame `b` in frame `a`, both in the root link's frame.
pub(crate) fn relative(a: &[[f64; 3]; 4], b: &[[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(a[k], v));
    [back(b[0]), back(b[1]), back(b[2]), back(sub(b[3], a[3]))]
}
