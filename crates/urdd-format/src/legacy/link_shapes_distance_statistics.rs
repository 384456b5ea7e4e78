//! `link_shapes_distance_statistics_module` 0.0.3: sampled distances between pairs of shapes.

use crate::types::module;

module! {
    /// Mean, largest and smallest distance of each pair of shapes over sampled configurations, metres.
    /// Negative where shapes penetrate; such depths depend on the library that computed them. How many
    /// configurations were sampled, and which, is not recorded.
    pub struct LinkShapesDistanceStatisticsModule {
        /// Between the links' convex hulls.
        pub full_convex_hulls: DistanceStatistics,
        /// Between the links' boxes.
        pub full_obbs: DistanceStatistics,
        /// Between the links' spheres.
        pub full_bounding_spheres: DistanceStatistics,
        /// Between convex pieces.
        pub decomposition_convex_hulls: DistanceStatistics,
        /// Between the boxes of convex pieces.
        pub decomposition_obbs: DistanceStatistics,
        /// Between the spheres of convex pieces.
        pub decomposition_bounding_spheres: DistanceStatistics,
    }

    /// Square matrices over shape indices, metres.
    pub struct DistanceStatistics {
        /// Mean distance of each pair.
        pub averages: Vec<Vec<f64>>,
        /// Largest distance of each pair.
        pub maximums: Vec<Vec<f64>>,
        /// Smallest distance of each pair.
        pub minimums: Vec<Vec<f64>>,
    }
}
