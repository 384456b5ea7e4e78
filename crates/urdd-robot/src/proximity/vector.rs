//! Poses as arrays.

use urdd_geometry::vector::{dot, sub};

/// Transforms a point from a link's frame to the root link's frame.
pub(crate) fn to_root(link: &[[f64; 3]; 4], p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| link[0][k] * p[0] + link[1][k] * p[1] + link[2][k] * p[2] + link[3][k])
}

/// The pose of frame `b` in frame `a`, both in the root link's frame.
pub(crate) fn relative(a: &[[f64; 3]; 4], b: &[[f64; 3]; 4]) -> [[f64; 3]; 4] {
    let back = |v: [f64; 3]| [0, 1, 2].map(|k| dot(a[k], v));
    [back(b[0]), back(b[1]), back(b[2]), back(sub(b[3], a[3]))]
}
