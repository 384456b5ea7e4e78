//! `original_meshes_module` 0.0.1 and 0.0.2: copies of the mesh files that the URDF names.

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
