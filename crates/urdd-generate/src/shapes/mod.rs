//! The link shape modules: SPEC 8.

pub(crate) mod approximations;
pub(crate) mod max_distances;
mod rounding;
pub(crate) mod simple_skips;
pub(crate) mod statistics;

use crate::meshes::written::{LinkMeshes, LinkPieces};
use urdd_format::index::{LinkIdx, PieceIdx};
use urdd_format::shapes::PieceShape;

/// Most pieces of a robot with matrices over pieces, which grow with the square of their number.
pub(crate) const MOST_PIECES_WITH_MATRICES: usize = 500;

/// The convex meshes that shapes are made of.
pub(crate) struct ConvexMeshes {
    /// For each link its hull.
    pub hulls: LinkMeshes,
    /// For each link its pieces.
    pub pieces: LinkPieces,
}

impl ConvexMeshes {
    /// What index i of a matrix over links stands for.
    pub fn full_shapes(&self) -> Vec<LinkIdx> {
        let links = (0..)
            .zip(self.hulls.iter())
            .filter(|(_, hull)| hull.is_some());
        links.map(|(link, _)| LinkIdx(link)).collect()
    }

    /// What index i of a matrix over pieces stands for.
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
