//! The farthest of points.

/// The first of the farthest points, with its distance.
pub(super) fn farthest(points: impl Iterator<Item = ([f64; 3], f64)>) -> Option<([f64; 3], f64)> {
    points.reduce(|a, b| if b.1 > a.1 { b } else { a })
}
