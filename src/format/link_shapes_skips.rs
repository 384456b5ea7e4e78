//! `link_shapes_skips_module`: the simple skips, after a person's edits.

use super::index::LinkIdx;
use super::object::{module, object};
use super::shapes::PieceShape;

module! {
    /// The pairs of shapes that a collision check may skip: the simple skips with a person's edits
    /// applied in order.
    pub struct LinkShapesSkipsModule {
        /// The edits, applied in order. What a person decides is free; the names must exist.
        pub edits: Vec<SkipEdit>,
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        pub full_shapes: Vec<LinkIdx>,
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        pub decomposition_shapes: Vec<PieceShape>,
        /// Skips between the links' convex hulls.
        pub full_convex_hulls_skips: Vec<Vec<bool>>,
        /// Skips between the links' boxes.
        pub full_obbs_skips: Vec<Vec<bool>>,
        /// Skips between the links' spheres.
        pub full_bounding_spheres_skips: Vec<Vec<bool>>,
        /// Skips between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls_skips: Option<Vec<Vec<bool>>>,
        /// Skips between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs_skips: Option<Vec<Vec<bool>>>,
        /// Skips between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres_skips: Option<Vec<Vec<bool>>>,
    }
}

object! {
    /// A person's word on a pair of links, for all their shapes of every kind.
    pub struct SkipEdit {
        /// Name of one link.
        pub link_a: String,
        /// Name of the other link; may be the same.
        pub link_b: String,
        /// Whether checks between the two are skipped from here on.
        pub skip: bool,
        /// Why.
        pub reason: String,
    }
}
