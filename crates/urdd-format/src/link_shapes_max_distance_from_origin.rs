//! `link_shapes_max_distance_from_origin_module`: maximum distance of shapes from their link's origin.

use super::types::module;

module! {
    /// The largest distance of any point of a shape from the origin of its link's frame, metres.
    pub struct LinkShapesMaxDistanceFromOriginModule {
        /// For each link, of its convex hull; null for a link without one.
        pub full_convex_hulls_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of its box; null for a link without one.
        pub full_obbs_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of its sphere; null for a link without one.
        pub full_bounding_spheres_maximum_distances: Vec<Option<f64>> where { unit: "m", length: "links" },
        /// For each link, of each convex piece.
        pub decomposition_convex_hulls_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
        /// For each link, of the box of each convex piece.
        pub decomposition_obbs_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
        /// For each link, of the sphere of each convex piece.
        pub decomposition_bounding_spheres_maximum_distances: Vec<Vec<f64>> where { unit: "m", length: "links, pieces" },
    }
}
