//! `convex_decomposition_meshes_module`: each link as a union of convex pieces.

use super::annotations::lengths;
use super::meshes::MeshFiles;
use super::object::{module, object};

module! {
    /// Each link's plain mesh as a union of convex pieces.
    pub struct ConvexDecompositionMeshesModule {
        /// How the pieces were made. Any method may be used, as long as `surface_tolerance` holds (7.10).
        pub method: DecompositionMethod,
        /// For each link its pieces; empty for a link without a plain mesh. The place in the list is
        /// the piece index.
        #[schemars(transform = lengths("links, pieces"))]
        pub link_pieces: Vec<Vec<MeshFiles>>,
    }
}

object! {
    /// How convex pieces were made.
    pub struct DecompositionMethod {
        /// Name of the algorithm.
        pub name: String,
        /// How far a point of the link's surface may lie outside the pieces, metres, where the
        /// algorithm promises that; else null.
        #[schemars(extend("x-unit" = "m"))]
        pub surface_tolerance: Option<f64>,
    }
}
