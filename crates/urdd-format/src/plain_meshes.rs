//! `plain_meshes_module`: one mesh per link, in the link's frame.

use super::meshes::{GeometryKind, MeshFiles};
use super::types::module;

module! {
    /// One mesh per link: all its geometry of one kind, with origin, rotation and scale applied and
    /// primitives tessellated.
    pub struct PlainMeshesModule {
        /// Which geometry is preferred; the other is used for a link that has none of it.
        pub preferred_geometry: GeometryKind,
        /// For each link its mesh, or null for a link without geometry.
        pub link_meshes: Vec<Option<PlainMesh>> where { length: "links" },
    }

    /// The mesh of a link.
    pub struct PlainMesh {
        /// Which geometry it was made from.
        pub geometry: GeometryKind,
        /// Its files.
        pub files: MeshFiles,
    }
}
