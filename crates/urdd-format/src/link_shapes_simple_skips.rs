//! `link_shapes_simple_skips_module`: pairs that need no collision check, found by sampling.

use super::index::LinkIdx;
use super::shapes::PieceShape;
use super::types::module;

module! {
    /// For each pair of shapes, whether the two are always in contact, so that checking them for
    /// collision says nothing, and the reason of the pair.
    pub struct LinkShapesSimpleSkipsModule {
        /// What index i of a `full_…` matrix stands for: the links that have a shape, ascending.
        pub full_shapes: Vec<LinkIdx> where { length: "full_shapes" },
        /// What index i of a `decomposition_…` matrix stands for: links ascending, pieces in order.
        pub decomposition_shapes: Vec<PieceShape> where { length: "decomposition_shapes" },
        /// Skips between the links' convex hulls: true where both shapes are on one link, or where
        /// the largest sampled distance is at most 0.001 m.
        pub full_convex_hulls_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' boxes.
        pub full_obbs_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between the links' spheres.
        pub full_bounding_spheres_simple_skips: Vec<Vec<bool>> where { square: "full_shapes" },
        /// Skips between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// Skips between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres_simple_skips: Option<Vec<Vec<bool>>> where { square: "decomposition_shapes" },
        /// The reason of each pair, for each of the matrices above.
        pub reasons: SkipReasons,
    }

    /// The reason of each pair, for each kind of shape.
    pub struct SkipReasons {
        /// Between the links' convex hulls.
        pub full_convex_hulls: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between the links' boxes.
        pub full_obbs: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between the links' spheres.
        pub full_bounding_spheres: Vec<Vec<SkipReason>> where { square: "full_shapes" },
        /// Between convex pieces; null where the statistics are.
        pub decomposition_convex_hulls: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
        /// Between the boxes of convex pieces; null where the statistics are.
        pub decomposition_obbs: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
        /// Between the spheres of convex pieces; null where the statistics are.
        pub decomposition_bounding_spheres: Option<Vec<Vec<SkipReason>>> where { square: "decomposition_shapes" },
    }

    /// The reason of a pair of shapes: the first of these that applies.
    pub enum SkipReason {
        /// Both shapes are on one link. A simple skip.
        SameLink,
        /// The largest sampled distance is at most 0.001 m: always in contact. A simple skip.
        Always,
        /// A joint connects the two links. Not a simple skip.
        Adjacent,
        /// The distance in the default configuration is at most 0.001 m: in contact when the robot
        /// stands still at zero. Not a simple skip.
        Default,
        /// The smallest sampled distance is more than 0.001 m: never in contact, as far as the samples
        /// show. Not a simple skip.
        Never,
        /// None of these: in contact in some of the sampled configurations and not in others.
        None,
    }
}

/// Shapes are in contact if their distance is at most this, metres (SPEC 8.6).
pub const CONTACT: f64 = 0.001;

/// What decides the reason of a pair of shapes.
pub struct SeenPair {
    /// Both shapes are on one link.
    pub is_same_link: bool,
    /// A joint connects the two links.
    pub is_joined: bool,
    /// The smallest and the largest sampled distance, metres.
    pub range: [f64; 2],
    /// The distance in the default configuration, metres.
    pub at_default: f64,
}

impl SeenPair {
    /// The reason: the first that applies.
    pub fn reason(&self) -> SkipReason {
        let [least, most] = self.range;
        if self.is_same_link {
            SkipReason::SameLink
        } else if most <= CONTACT {
            SkipReason::Always
        } else if self.is_joined {
            SkipReason::Adjacent
        } else if self.at_default <= CONTACT {
            SkipReason::Default
        } else if least > CONTACT {
            SkipReason::Never
        } else {
            SkipReason::None
        }
    }
}

impl SkipReason {
    /// Whether a pair with this reason is a simple skip.
    pub fn is_simple(self) -> bool {
        matches!(self, SkipReason::SameLink | SkipReason::Always)
    }

    /// Whether the pair is apart in some configuration and is no neighbour: its contact is a collision.
    pub fn can_collide(self) -> bool {
        matches!(self, SkipReason::Default | SkipReason::Never | SkipReason::None)
    }
}
