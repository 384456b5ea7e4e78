//! `convex_decomposition_meshes_module` 0.0.1: each link as a union of convex pieces.

use crate::types::module;

module! {
    /// Each link's plain mesh as convex pieces, in three formats, in the link's frame.
    pub struct ConvexDecompositionMeshesModule {
        /// For each link its pieces, STL; relative to the folder above the URDD.
        pub stl_link_mesh_relative_paths: Vec<Vec<String>>,
        /// For each link its pieces, Wavefront OBJ; relative to the folder above the URDD.
        pub obj_link_mesh_relative_paths: Vec<Vec<String>>,
        /// For each link its pieces, glTF JSON with embedded buffers; relative to the folder above the URDD.
        pub glb_link_mesh_relative_paths: Vec<Vec<String>>,
    }
}
