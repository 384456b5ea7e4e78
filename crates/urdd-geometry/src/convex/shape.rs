//! Convex shapes.

use nalgebra::{Isometry3, Vector3};

use super::support_table::SupportTable;
use crate::mesh::{Bounds, Mesh};
use crate::vector::sub;

/// The convex hull of points, prepared for distance queries.
#[derive(Clone, Debug)]
pub struct ConvexShape {
    /// Centre of the axis-aligned bounds, in the body frame.
    pub(crate) centre: [f64; 3],
    /// Half of the sizes of these bounds.
    half_extents: [f64; 3],
    /// Support table of the points relative to the centre.
    pub(crate) table: SupportTable,
}

/// A box, prepared for distance queries.
#[derive(Clone, Debug, PartialEq)]
pub struct OrientedBox {
    pub(crate) pose: Isometry3<f64>,
    pub(crate) half_extents: [f64; 3],
}

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    pub(crate) centre: [f64; 3],
    pub(crate) radius: f64,
}

/// Why a convex shape cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// There are no vertices.
    #[error("the shape has no vertices; give at least one")]
    Empty,
    /// A vertex is not finite, or too far from the origin.
    #[error("vertex {vertex} is not finite, or farther than 1e9 m from the origin")]
    OutOfRange {
        /// Index of the vertex.
        vertex: usize,
    },
    /// The pose is not finite, or too far from the origin.
    #[error("the centre or the axes are not finite, or farther than 1e9 m from the origin")]
    Pose,
    /// A size is negative, too large or not finite.
    #[error("a half extent or radius is {size}; give one from 0 to 1e9 m")]
    Size {
        /// The half extent or radius, metres.
        size: f64,
    },
}

/// Maximum coordinate, metres. Fourth powers of much larger ones would overflow, and no robot is that large.
const FARTHEST: f64 = 1e9;

fn in_range(v: &[f64; 3]) -> bool {
    v.iter().all(|x| x.abs() <= FARTHEST)
}

impl ConvexShape {
    /// The convex hull of a mesh's vertices; ignores the triangles. A hull may be a polygon, a segment or a point.
    pub fn new(mesh: &Mesh) -> Result<Self, ShapeError> {
        Self::of_points(&mesh.vertices)
    }

    /// The convex hull of points, metres. Interior points only cost preparation time.
    pub fn of_points(points: &[[f64; 3]]) -> Result<Self, ShapeError> {
        if let Some(vertex) = points.iter().position(|p| !in_range(p)) {
            return Err(ShapeError::OutOfRange { vertex });
        }
        if points.is_empty() {
            return Err(ShapeError::Empty);
        }
        let Bounds { min, max } = Bounds::of(points.iter().copied());
        let centre: [f64; 3] = std::array::from_fn(|k| 0.5 * min[k] + 0.5 * max[k]);
        let points: Vec<[f64; 3]> = points.iter().map(|p| sub(*p, centre)).collect();
        let farthest = |most: f64, x: f64| most.max(x.abs());
        let half_extents = [0, 1, 2].map(|k| points.iter().map(|p| p[k]).fold(0.0, farthest));
        let table = SupportTable::new(&points);
        Ok(Self { centre, half_extents, table })
    }

    /// Centre of the axis-aligned bounds, in the body frame, metres.
    pub fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// Half of the sizes of the axis-aligned bounds, metres.
    pub fn half_extents(&self) -> [f64; 3] {
        self.half_extents
    }
}

impl OrientedBox {
    /// A box from the pose of its centre and axes in the body frame, and its half extents, metres.
    pub fn new(pose: Isometry3<f64>, half_extents: [f64; 3]) -> Result<Self, ShapeError> {
        let rotation = pose.rotation.coords;
        if !in_range(&pose.translation.vector.into()) || !rotation.iter().all(|x| x.is_finite()) {
            return Err(ShapeError::Pose);
        }
        match half_extents.into_iter().find(|h| !(0.0..=FARTHEST).contains(h)) {
            Some(size) => Err(ShapeError::Size { size }),
            None => Ok(Self { pose, half_extents }),
        }
    }
}

impl Sphere {
    /// A sphere from its centre in the body frame and its radius, metres.
    pub fn new(centre: Vector3<f64>, radius: f64) -> Result<Self, ShapeError> {
        let centre = centre.into();
        if !in_range(&centre) {
            Err(ShapeError::Pose)
        } else if !(0.0..=FARTHEST).contains(&radius) {
            Err(ShapeError::Size { size: radius })
        } else {
            Ok(Self { centre, radius })
        }
    }
}
