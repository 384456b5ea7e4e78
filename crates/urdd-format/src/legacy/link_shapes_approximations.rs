//! `link_shapes_approximations_module` 0.0.3: boxes and spheres around links and pieces.

// Boxes are as in version 1.
pub use crate::link_shapes_approximations::Obb;
use crate::types::module;

module! {
    /// Oriented bounding boxes (OBBs) and bounding spheres of each link and of each convex piece, in
    /// the link's frame.
    pub struct LinkShapesApproximationsModule {
        /// For each link its box; null for a link without a mesh.
        pub full_obbs: Vec<Option<Obb>>,
        /// For each link its sphere; null for a link without a mesh.
        pub full_bounding_spheres: Vec<Option<BoundingSphere>>,
        /// For each link, a box for each convex piece.
        pub decomposition_obbs: Vec<Vec<Obb>>,
        /// For each link, a sphere for each convex piece.
        pub decomposition_bounding_spheres: Vec<Vec<BoundingSphere>>,
    }

    /// A bounding sphere.
    pub struct BoundingSphere {
        /// Radius, metres.
        pub radius: f64,
        /// Centre in the link's frame, metres.
        pub offset_xyz: [f64; 3],
        /// A rotation, which means nothing for a sphere.
        pub offset_rpy: [f64; 3],
    }
}
