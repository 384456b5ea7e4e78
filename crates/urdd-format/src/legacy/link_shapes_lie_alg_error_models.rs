//! `link_shapes_lie_alg_error_models_module` 0.0.1 and 0.0.2: error of linearised distances. Both
//! versions have the same structure.

use crate::types::module;

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
