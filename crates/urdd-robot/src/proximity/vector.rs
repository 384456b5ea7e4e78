//! Poses as arrays.

/// Transforms a point from a link's frame to the root link's frame.
pub(crate) fn to_root(link: &[[f64; 3]; 4], p: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| link[0][k] * p[0] + link[1][k] * p[1] + link[2][k] * p[2] + link[3][k])
}
