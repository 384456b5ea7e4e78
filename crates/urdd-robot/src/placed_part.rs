//! Parts of obstacles at their poses.

use nalgebra::{Isometry3, UnitQuaternion};

use super::obstacle::Part;
use super::proximity::to_root;
use urdd_geometry::bounding_sphere::BoundingSphere;
use urdd_geometry::convex::across::columns;
use urdd_geometry::vector::{dot, norm, sub};

/// A part of an obstacle, at its pose.
#[derive(Debug, Clone)]
pub(super) struct PlacedPart {
    pub obstacle: usize,
    pub part: Part,
    /// The columns of the rotation of the obstacle's frame, then its translation.
    pub frame: [[f64; 3]; 4],
    /// Whether that is a rotation.
    is_turned: bool,
    /// More than what is rounded in its frame, m.
    pub rounding: f64,
    /// Around the part, in the root link's frame.
    sphere: BoundingSphere,
}

impl PlacedPart {
    pub fn new(obstacle: usize, part: Part, pose: &Isometry3<f64>) -> Self {
        let (frame, is_turned, rounding, sphere) = ([[0.0; 3]; 4], false, 0.0, part.sphere);
        let mut placed = PlacedPart { obstacle, part, frame, is_turned, rounding, sphere };
        placed.place(pose);
        placed
    }

    pub fn place(&mut self, pose: &Isometry3<f64>) {
        self.frame = columns(pose);
        self.is_turned = pose.rotation != UnitQuaternion::identity();
        self.rounding = 1e-12 * norm(self.frame[3]);
        let BoundingSphere { centre, radius } = self.part.sphere;
        let centre = to_root(&self.frame, centre);
        self.sphere = BoundingSphere { centre, radius: radius + self.rounding };
    }

    /// A point of the root link's frame in its frame.
    pub fn local(&self, point: [f64; 3]) -> [f64; 3] {
        let from = sub(point, self.frame[3]);
        match self.is_turned {
            true => [0, 1, 2].map(|k| dot(self.frame[k], from)),
            false => from,
        }
    }

    /// A lower bound of the distance from a sphere, m; not positive if they may touch.
    pub fn bound(&self, centre: [f64; 3], radius: f64) -> f64 {
        let centre = self.local(centre);
        self.part.bound(&BoundingSphere { centre, radius: radius + self.rounding })
    }

    /// Whether it is certainly farther from a sphere than `distance`, m.
    pub fn is_beyond(&self, centre: [f64; 3], radius: f64, distance: f64) -> bool {
        let from = sub(centre, self.sphere.centre);
        let reach = radius + self.sphere.radius + distance;
        dot(from, from) * (1.0 - 1e-12) > reach * reach || self.bound(centre, radius) > distance
    }
}
