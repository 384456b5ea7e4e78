//! The link shape modules: SPEC 8.

pub(crate) mod approximations;
pub(crate) mod simple_skips;
pub(crate) mod statistics;

use crate::meshes::written::WrittenMesh;
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::link_shapes_approximations::{BoundingSphere, Obb};
use urdd_format::shapes::PieceShape;

/// Maximum number of pieces with matrices over pieces, which grow with the square of that number.
pub(crate) const MOST_PIECES_WITH_MATRICES: usize = 500;

/// The convex meshes from which shapes are built.
#[derive(Clone, Copy)]
pub(crate) struct ConvexMeshes<'a> {
    pub hulls: &'a [Option<WrittenMesh>],
    pub pieces: &'a [Vec<WrittenMesh>],
}

/// The oriented bounding box and the bounding sphere of a hull or a piece.
pub(crate) type Shape = (Obb, BoundingSphere);

impl ConvexMeshes<'_> {
    /// The links at the indices of a matrix over links.
    pub fn full_shapes(&self) -> Vec<LinkIdx> {
        let links = (0..).zip(self.hulls.iter()).filter(|(_, hull)| hull.is_some());
        links.map(|(link, _)| LinkIdx(link)).collect()
    }

    /// The pieces at the indices of a matrix over pieces.
    pub fn decomposition_shapes(&self) -> Vec<PieceShape> {
        let links = (0..).zip(self.pieces.iter());
        links
            .flat_map(|(link, pieces)| {
                (0..).zip(pieces).map(move |(piece, _)| PieceShape {
                    link_idx: LinkIdx(link),
                    piece_idx: PieceIdx(piece),
                })
            })
            .collect()
    }
}

/// The powers of ten that scale numbers from 10^-6 to 10^6 to seven digits before the point. All are exact.
const SCALES: [f64; 12] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Rounds a distance to seven significant digits (SPEC 8.5 says what that may change). Distances below 10^-6 m, and
/// from 10^6 m on, are unchanged. Rounding is monotonic.
pub fn seven_digits(x: f64) -> f64 {
    let scale = SCALES.iter().find(|scale| (1e6..1e7).contains(&(x * **scale)));
    match scale {
        // An integer divided by a power of ten, both exact: the quotient is the binary64 nearest to the decimal.
        Some(scale) => (x * scale).round() / scale,
        None => x,
    }
}
