//! `convex_decomposition_meshes_module`: each link as a union of convex pieces.

use super::meshes::MeshFiles;
use super::types::module;

module! {
    /// Each link's plain mesh as a union of convex pieces.
    pub struct ConvexDecompositionMeshesModule {
        /// How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10).
        pub method: DecompositionMethod,
        /// For each link its pieces; empty for a link without a plain mesh. The place in the list is
        /// the piece index.
        pub link_pieces: Vec<Vec<MeshFiles>> where { length: "links, pieces" },
    }

    /// How convex pieces were made.
    pub struct DecompositionMethod {
        /// Name of the algorithm.
        pub name: String,
        /// How far a point of the link's surface may lie outside the pieces, metres, where the
        /// algorithm promises that; else null.
        pub surface_tolerance: Option<f64> where { unit: "m" },
    }
}
