//! `convex_hull_meshes_module`: the convex hull of each link.

use super::meshes::MeshFiles;
use super::types::module;

module! {
    /// The convex hull of each link's plain mesh.
    pub struct ConvexHullMeshesModule {
        /// For each link its hull, or null for a link without a plain mesh.
        pub link_hulls: Vec<Option<MeshFiles>> where { length: "links" },
    }
}
