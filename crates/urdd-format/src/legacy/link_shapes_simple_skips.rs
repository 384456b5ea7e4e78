//! `link_shapes_simple_skips_module` 0.0.5: pairs that need no collision check, found by sampling.

use crate::types::module;

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
