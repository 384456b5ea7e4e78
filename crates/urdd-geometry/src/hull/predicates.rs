//! Exact orientation tests: Shewchuk's adaptive predicates from the `robust` crate.
//!
//! J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete &
//! Computational Geometry 18 (1997). The predicates are exact while no product of three coordinate differences
//! overflows or loses bits to underflow. [`in_range`] ensures this.

use std::cmp::Ordering;

use robust::{Coord, Coord3D};

/// A point, metres.
pub type Point = [f64; 3];

/// Whether the predicates are exact for this coordinate: 0, or a magnitude of 1e-60 to 1e60. Such numbers are multiples
/// of 2^-252, so products of three differences are multiples of 2^-756 and below 1e182: doubles represent every bit
/// that an expansion needs. All finite f32 values qualify.
pub fn in_range(x: f64) -> bool {
    x == 0.0 || (1e-60..=1e60).contains(&x.abs())
}

/// The side of the plane through `a`, `b`, `c` that `p` is on, exact: `Greater` on the side from which the three appear
/// counterclockwise, `Equal` on the plane.
pub fn side_of_plane(a: Point, b: Point, c: Point, p: Point) -> Ordering {
    let at = |[x, y, z]: Point| Coord3D { x, y, z };
    // robust returns the sign of the tetrahedron's volume: positive below the plane.
    compare_to_zero(-robust::orient3d(at(a), at(b), at(c), at(p)))
}

/// The orientation of `a`, `b`, `c`, exact: `Greater` for counterclockwise, `Equal` for collinear.
pub fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> Ordering {
    let at = |[x, y]: [f64; 2]| Coord { x, y };
    compare_to_zero(robust::orient2d(at(a), at(b), at(c)))
}

/// Whether three points are collinear, exact: they are if all three axis-aligned projections are.
pub fn collinear(a: Point, b: Point, c: Point) -> bool {
    [[0, 1], [1, 2], [2, 0]].iter().all(|[i, j]| {
        let shadow = |p: Point| [p[*i], p[*j]];
        turn(shadow(a), shadow(b), shadow(c)) == Ordering::Equal
    })
}

/// Order by x, then y, then z.
pub fn lexicographic(a: &Point, b: &Point) -> Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

fn compare_to_zero(x: f64) -> Ordering {
    // Adding 0 turns -0.0 into 0.0; total_cmp distinguishes the two.
    (x + 0.0).total_cmp(&0.0)
}
