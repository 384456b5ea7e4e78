//! `link_shapes_max_distance_from_origin_module`: maximum distance of shapes from their link's origin.

use super::annotations::lengths;
use super::object::module;

module! {
    /// The largest distance of any point of a shape from the origin of its link's frame, metres.
    pub struct LinkShapesMaxDistanceFromOriginModule {
        /// For each link, of its convex hull; null for a link without one.
        #[schemars(transform = lengths("links"), extend("x-unit" = "m"))]
        pub full_convex_hulls_maximum_distances: Vec<Option<f64>>,
        /// For each link, of its box; null for a link without one.
        #[schemars(transform = lengths("links"), extend("x-unit" = "m"))]
        pub full_obbs_maximum_distances: Vec<Option<f64>>,
        /// For each link, of its sphere; null for a link without one.
        #[schemars(transform = lengths("links"), extend("x-unit" = "m"))]
        pub full_bounding_spheres_maximum_distances: Vec<Option<f64>>,
        /// For each link, of each convex piece.
        #[schemars(transform = lengths("links, pieces"), extend("x-unit" = "m"))]
        pub decomposition_convex_hulls_maximum_distances: Vec<Vec<f64>>,
        /// For each link, of the box of each convex piece.
        #[schemars(transform = lengths("links, pieces"), extend("x-unit" = "m"))]
        pub decomposition_obbs_maximum_distances: Vec<Vec<f64>>,
        /// For each link, of the sphere of each convex piece.
        #[schemars(transform = lengths("links, pieces"), extend("x-unit" = "m"))]
        pub decomposition_bounding_spheres_maximum_distances: Vec<Vec<f64>>,
    }
}
