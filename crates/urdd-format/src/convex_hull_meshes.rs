//! `convex_hull_meshes_module`: the convex hull of each link.

use super::annotations::lengths;
use super::meshes::MeshFiles;
use super::object::module;

module! {
    /// The convex hull of each link's plain mesh.
    pub struct ConvexHullMeshesModule {
        /// For each link its hull, or null for a link without a plain mesh.
        #[schemars(transform = lengths("links"))]
        pub link_hulls: Vec<Option<MeshFiles>>,
    }
}
