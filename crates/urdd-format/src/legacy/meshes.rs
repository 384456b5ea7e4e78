//! Legacy mesh modules. Both versions of `plain_meshes_module` have the same structure.

use crate::types::module;

module! {
    /// Version 0.0.1: a visual mesh of each link, copied.
    pub struct OriginalMeshesModule {
        /// For each link the copy of its mesh, relative to the folder above the URDD; null for a link
        /// without one. Links whose meshes have one file name share a path, and then a file.
        pub link_mesh_relative_paths: Vec<Option<String>>,
    }
}

module! {
    /// Version 0.0.2: the visual meshes of each link, copied.
    pub struct OriginalMeshListsModule {
        /// For each link the copies of its meshes, relative to the folder above the URDD.
        pub link_mesh_relative_paths: Vec<Vec<String>>,
    }
}

module! {
    /// One mesh per link, in three formats, in the link's frame: the visual's origin is applied, its
    /// scale is not. A link whose visual is no mesh has none.
    pub struct PlainMeshesModule {
        /// For each link its mesh or null, STL; relative to the folder above the URDD.
        pub stl_link_mesh_relative_paths: Vec<Option<String>>,
        /// For each link its mesh or null, Wavefront OBJ; relative to the folder above the URDD.
        pub obj_link_mesh_relative_paths: Vec<Option<String>>,
        /// For each link its mesh or null, glTF JSON with embedded buffers; relative to the folder above the URDD.
        pub glb_link_mesh_relative_paths: Vec<Option<String>>,
    }
}

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
