//! Legacy link shape modules. All versions of a module have the same structure.

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

module! {
    /// Square matrices over shape indices: true where both shapes are on one link, or where the largest
    /// sampled distance of the pair is at most 0.001 m.
    pub struct LinkShapesSimpleSkipsModule {
        /// Between the links' convex hulls.
        pub full_convex_hulls_simple_skips: Vec<Vec<bool>>,
        /// Between the links' boxes.
        pub full_obbs_simple_skips: Vec<Vec<bool>>,
        /// Between the links' spheres.
        pub full_bounding_spheres_simple_skips: Vec<Vec<bool>>,
        /// Between convex pieces.
        pub decomposition_convex_hulls_simple_skips: Vec<Vec<bool>>,
        /// Between the boxes of convex pieces.
        pub decomposition_obbs_simple_skips: Vec<Vec<bool>>,
        /// Between the spheres of convex pieces.
        pub decomposition_bounding_spheres_simple_skips: Vec<Vec<bool>>,
    }
}

module! {
    /// Square matrices over shape indices: true where a collision check may skip the pair. The simple
    /// skips with a person's edits; the edits themselves are not recorded.
    pub struct LinkShapesSkipsModule {
        /// Between the links' convex hulls.
        pub full_convex_hulls_skips: Vec<Vec<bool>>,
        /// Between the links' boxes.
        pub full_obbs_skips: Vec<Vec<bool>>,
        /// Between the links' spheres.
        pub full_bounding_spheres_skips: Vec<Vec<bool>>,
        /// Between convex pieces.
        pub decomposition_convex_hulls_skips: Vec<Vec<bool>>,
        /// Between the boxes of convex pieces.
        pub decomposition_obbs_skips: Vec<Vec<bool>>,
        /// Between the spheres of convex pieces.
        pub decomposition_bounding_spheres_skips: Vec<Vec<bool>>,
    }
}

/// Coefficients of the lower bound, then of the upper bound.
pub type ErrorBounds = [[f64; 3]; 2];

module! {
    /// How far the distance between two shapes may be from its first-order estimate after a relative
    /// motion of a given size: square matrices over shape indices, zeros on the diagonal. Each element
    /// is two lists of three polynomial coefficients: the 1 % and the 99 % quantile of the error.
    /// *Standard* uses the exponential map of SE(3), *pseudo* the converter's cheaper substitute for it.
    pub struct LinkShapesLieAlgErrorModelsModule {
        /// Standard model, between the links' convex hulls.
        pub full_convex_hulls_standard_models: Vec<Vec<ErrorBounds>>,
        /// Standard model, between the links' boxes.
        pub full_obbs_standard_models: Vec<Vec<ErrorBounds>>,
        /// Standard model, between the links' spheres.
        pub full_bounding_spheres_standard_models: Vec<Vec<ErrorBounds>>,
        /// Standard model, between convex pieces.
        pub decomposition_convex_hulls_standard_models: Vec<Vec<ErrorBounds>>,
        /// Standard model, between the boxes of convex pieces.
        pub decomposition_obbs_standard_models: Vec<Vec<ErrorBounds>>,
        /// Standard model, between the spheres of convex pieces.
        pub decomposition_bounding_spheres_standard_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between the links' convex hulls.
        pub full_convex_hulls_pseudo_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between the links' boxes.
        pub full_obbs_pseudo_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between the links' spheres.
        pub full_bounding_spheres_pseudo_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between convex pieces.
        pub decomposition_convex_hulls_pseudo_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between the boxes of convex pieces.
        pub decomposition_obbs_pseudo_models: Vec<Vec<ErrorBounds>>,
        /// Pseudo model, between the spheres of convex pieces.
        pub decomposition_bounding_spheres_pseudo_models: Vec<Vec<ErrorBounds>>,
    }
}
