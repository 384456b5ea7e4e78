//! `link_shapes_distance_statistics_module`: sampled distances between pairs of shapes.

use super::index::{Count, LinkIdx};
use super::shapes::PieceShape;
use super::types::module;

module! {
    /// Mean, smallest and largest distance of each pair of shapes over the specification's sampled
    /// configurations, metres. A distance is 0 where the shapes touch or overlap.
    pub struct LinkShapesDistanceStatisticsModule {
        /// Number of sampled configurations, from the first of the specification's sequence.
        pub num_samples: Count,
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        pub full_shapes: Vec<LinkIdx> where { length: "full_shapes" },
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        pub decomposition_shapes: Vec<PieceShape> where { length: "decomposition_shapes" },
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

    /// Square symmetric matrices over one list of shapes, metres.
    pub struct DistanceStatistics {
        /// Mean distance of each pair.
        pub mean_distances: Vec<Vec<f64>> where { unit: "m", square: "full_shapes or decomposition_shapes" },
        /// Smallest distance of each pair.
        pub min_distances: Vec<Vec<f64>> where { unit: "m", square: "full_shapes or decomposition_shapes" },
        /// Largest distance of each pair.
        pub max_distances: Vec<Vec<f64>> where { unit: "m", square: "full_shapes or decomposition_shapes" },
    }
}
