//! `plain_meshes_module` 0.0.1 and 0.0.2: one mesh per link. Both versions have the same structure.

use crate::types::module;

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
