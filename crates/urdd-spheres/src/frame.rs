//! Points, and poses of links as matrices, since each pose is used many times.

use nalgebra::Isometry3;

pub use urdd_geometry::vector::{cross, dot, norm, sub};

/// A point or a vector, in metres.
pub type Point = [f64; 3];

#[inline]
pub fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline]
pub fn scaled(a: Point, by: f64) -> Point {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// A pose: the columns of the rotation matrix, and the translation.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    columns: [Point; 3],
    shift: Point,
}

impl From<&Isometry3<f64>> for Pose {
    fn from(pose: &Isometry3<f64>) -> Self {
        let rotation = pose.rotation.to_rotation_matrix();
        Pose {
            columns: [0, 1, 2].map(|k| rotation.matrix().column(k).into_owned().into()),
            shift: pose.translation.vector.into(),
        }
    }
}

impl Pose {
    /// Transforms a point from the link's frame to the root link's frame.
    #[inline]
    pub fn place(&self, p: Point) -> Point {
        let [x, y, z] = self.columns;
        [0, 1, 2].map(|k| x[k] * p[0] + y[k] * p[1] + z[k] * p[2] + self.shift[k])
    }

    /// Rotates a direction from the root link's frame to the link's frame.
    #[inline]
    pub fn turn_back(&self, v: Point) -> Point {
        self.columns.map(|column| dot(column, v))
    }
}
