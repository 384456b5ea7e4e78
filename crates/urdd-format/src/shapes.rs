//! Shape indices, shared by the link shape modules.

use super::index::{LinkIdx, PieceIdx};
use super::types::types;

types! {
    /// A convex piece of a link.
    pub struct PieceShape {
        /// The link.
        pub link_idx: LinkIdx,
        /// The piece, as in `link_pieces` of `convex_decomposition_meshes_module`.
        pub piece_idx: PieceIdx,
    }
}
