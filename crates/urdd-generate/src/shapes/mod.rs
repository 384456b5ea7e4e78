//! The link shape modules: SPEC 8.

pub(crate) mod approximations;
pub(crate) mod max_distances;
#[doc(hidden)]
pub mod rounding;
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
    /// The hull of each link.
    pub hulls: &'a [Option<WrittenMesh>],
    /// The pieces of each link.
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
