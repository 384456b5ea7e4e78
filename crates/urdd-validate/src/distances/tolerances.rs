//! Tolerances of distances (SPEC 8.5).

use super::shape_set::volumes;
use crate::solids::Solids;
use crate::tolerance::{distance_tolerance, reach};
use urdd_document::shapes::Shapes;
use urdd_document::urdd::Urdd;
use urdd_format::shape_kind::ShapeKind;
use urdd_geometry::farthest;

/// The tolerances of one kind of shapes.
pub struct Tolerances {
    /// The robot's reach, m.
    reach: f64,
    /// Reach of each shape from its link's origin, m.
    shapes: Vec<f64>,
}

impl Tolerances {
    /// For the shapes of a kind. A missing shape, which other rules report, adds nothing.
    pub fn new(urdd: &Urdd, solids: &Solids, shapes: &Shapes, kind: ShapeKind) -> Self {
        let volumes = volumes(urdd, kind);
        let of_shape = |shape: usize| -> Option<f64> {
            let (link, piece) = shapes.place(kind, shape)?;
            Some(match kind.is_convex_mesh() {
                true => farthest::of_mesh(solids.sound(kind.meshes(), link, piece)?),
                false => volumes.as_ref()?.links.get(link)?.get(piece)?.reach(),
            })
        };
        let robot = urdd.robot().zip(urdd.tree());
        Tolerances {
            reach: robot.map_or(0.0, |(robot, tree)| reach(robot, tree)),
            shapes: (0..shapes.count(kind)).map(|shape| of_shape(shape).unwrap_or(0.0)).collect(),
        }
    }

    /// Tolerance of the distances of two shapes, m.
    pub fn pair(&self, i: usize, j: usize) -> f64 {
        let of = |shape: usize| self.shapes.get(shape).copied().unwrap_or(0.0);
        distance_tolerance(self.reach, of(i) + of(j))
    }
}
