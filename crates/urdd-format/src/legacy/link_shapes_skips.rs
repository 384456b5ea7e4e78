//! `link_shapes_skips_module` 0.0.1 and 0.0.2: the simple skips, with manual edits applied. Both versions
//! have the same structure.

use crate::types::module;

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
