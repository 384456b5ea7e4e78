//! `link_shapes_distance_statistics_module`: sampled distances between pairs of shapes.

use super::annotations::lengths;
use super::index::{Count, LinkIdx};
use super::object::{module, object};
use super::shapes::PieceShape;

module! {
    /// Mean, smallest and largest distance of each pair of shapes over the specification's sampled
    /// configurations, metres. A distance is 0 where the shapes touch or overlap.
    pub struct LinkShapesDistanceStatisticsModule {
        /// Number of sampled configurations, from the first of the specification's sequence.
        pub num_samples: Count,
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        #[schemars(transform = lengths("full_shapes"))]
        pub full_shapes: Vec<LinkIdx>,
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        #[schemars(transform = lengths("decomposition_shapes"))]
        pub decomposition_shapes: Vec<PieceShape>,
        /// Between the links' convex hulls.
        pub full_convex_hulls: DistanceStatistics,
        /// Between the links' boxes.
        pub full_obbs: DistanceStatistics,
        /// Between the links' spheres.
        pub full_bounding_spheres: DistanceStatistics,
        /// Between convex pieces; null above 500 pieces, unless asked for.
        pub decomposition_convex_hulls: Option<DistanceStatistics>,
        /// Between the boxes of convex pieces; null above 500 pieces, unless asked for.
        pub decomposition_obbs: Option<DistanceStatistics>,
        /// Between the spheres of convex pieces; null above 500 pieces, unless asked for.
        pub decomposition_bounding_spheres: Option<DistanceStatistics>,
    }
}

object! {
    /// Square symmetric matrices over one list of shapes, metres.
    pub struct DistanceStatistics {
        /// Mean distance of each pair.
        #[schemars(transform = lengths("full_shapes or decomposition_shapes, full_shapes or decomposition_shapes"), extend("x-unit" = "m"))]
        pub mean_distances: Vec<Vec<f64>>,
        /// Smallest distance of each pair.
        #[schemars(transform = lengths("full_shapes or decomposition_shapes, full_shapes or decomposition_shapes"), extend("x-unit" = "m"))]
        pub min_distances: Vec<Vec<f64>>,
        /// Largest distance of each pair.
        #[schemars(transform = lengths("full_shapes or decomposition_shapes, full_shapes or decomposition_shapes"), extend("x-unit" = "m"))]
        pub max_distances: Vec<Vec<f64>>,
    }
}
