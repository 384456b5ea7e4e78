//! `convex_hull_meshes_module` 0.0.1: the convex hull of each link.

use crate::types::module;

module! {
    /// The convex hull of each link's plain mesh, in three formats, in the link's frame.
    pub struct ConvexHullMeshesModule {
        /// For each link its hull or null, STL; relative to the folder above the URDD.
        pub stl_link_mesh_relative_paths: Vec<Option<String>>,
        /// For each link its hull or null, Wavefront OBJ; relative to the folder above the URDD.
        pub obj_link_mesh_relative_paths: Vec<Option<String>>,
        /// For each link its hull or null, glTF JSON with embedded buffers; relative to the folder above the URDD.
        pub glb_link_mesh_relative_paths: Vec<Option<String>>,
    }
}
