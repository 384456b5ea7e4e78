//! Errors of the hull.

/// Why a set of points has no hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HullError {
    /// There are no points.
    #[error("there are no points")]
    Empty,
    /// A coordinate is NaN, infinite, or outside the range of exact arithmetic.
    #[error(
        "point {point} has a coordinate that is neither 0 nor between 1e-60 and 1e60 m in size"
    )]
    OutOfRange {
        /// Index of the point.
        point: usize,
    },
    /// All points coincide.
    #[error("all points coincide")]
    Point,
    /// All points are collinear.
    #[error("all points lie on one line")]
    Line,
    /// More points than a 32-bit index can address.
    #[error("more than 4,294,967,294 points")]
    TooMany,
}
