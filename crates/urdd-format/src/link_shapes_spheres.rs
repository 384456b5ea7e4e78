//! `link_shapes_spheres_module`: spheres that stand for the links of a robot, in levels from coarse to fine. Since version 1.1
//! of the specification.

use super::index::{Count, LevelIdx, SphereIdx};
use super::rate::Rate;
use super::self_collision_model::LinkPair;
use super::types::module;

/// First sampled configuration that contacts and counts are of (SPEC 8.9.6).
pub const SPHERES_FIRST: u32 = 1 << 31;
/// The most sampled configurations (SPEC 8.9.2).
pub const SPHERES_MAX_SAMPLES: u32 = 100_000;
/// The most levels, and the most spheres of a level (SPEC 8.9.2).
pub const SPHERES_MAX_LEVELS: usize = 16;
/// The most spheres of a level (SPEC 8.9.2).
pub const SPHERES_MAX_IN_LEVEL: usize = 65_536;

module! {
    /// Spheres that stand for the convex pieces of links, for programs that check very many configurations.
    pub struct LinkShapesSpheresModule {
        /// The levels, from coarse to fine. The first has one sphere for each link with a piece.
        pub levels: Vec<SphereLevel>,
        /// How many sampled configurations (SPEC 9.3), from 2^31 on, pairs and counts of the levels are of.
        pub num_samples: Count,
    }

    /// A level: spheres of each link, and what they say.
    pub struct SphereLevel {
        /// Where the spheres are from.
        pub origin: SphereOrigin,
        /// Whether every point of every piece is in a sphere of its link. Such a level never calls a collision free.
        pub covers: bool,
        /// The level before this one whose spheres hold the spheres of this one; null for the first level.
        pub outer_level_idx: Option<LevelIdx>,
        /// For each link, its spheres; none for a link without a piece.
        pub spheres: Vec<Vec<LinkSphere>> where { length: "links" },
        /// For each link, how far its spheres are from its pieces; null for a link without spheres.
        pub fits: Vec<Option<SphereFit>> where { length: "links" },
        /// Pairs of links that a check by this level leaves out, besides the skipped ones (SPEC 8.8.5): they were in no
        /// sampled collision, and their spheres touch all the same. None for a level that covers.
        pub ignored_pairs: Vec<LinkPair>,
        /// Pairs of links with a sphere of each in contact in every sampled configuration.
        pub always_pairs: Vec<LinkPair>,
        /// Pairs of links with a sphere of each in contact in some of the sampled configurations, and not in all. All other
        /// pairs are in contact in none.
        pub sometimes_pairs: Vec<LinkPair>,
        /// How often a check by this level is right in the sampled configurations.
        pub evaluation: SphereEvaluation,
    }

    /// Where the spheres of a level are from.
    pub enum SphereOrigin {
        /// A program made them from the pieces.
        Computed,
        /// A person gave them. A producer that makes the module again keeps them.
        Given,
    }

    /// A sphere of a link.
    pub struct LinkSphere {
        /// Radius, metres.
        pub radius: f64 where { unit: "m" },
        /// Centre in the link's frame, metres.
        pub offset_xyz: [f64; 3] where { unit: "m", frame: "link" },
        /// The sphere of the same link in the outer level that this one is inside of; null in the first level.
        pub outer_sphere_idx: Option<SphereIdx>,
    }

    /// How far the spheres of a link are from its pieces, by the points of SPEC 8.9.5.
    pub struct SphereFit {
        /// The largest distance of a point on the spheres from the pieces, metres.
        pub max_standoff: f64 where { unit: "m" },
        /// The mean distance of points on the spheres from the pieces, metres.
        pub mean_standoff: f64 where { unit: "m" },
        /// The part of the surface of the pieces that is outside of all spheres, from 0 to 1.
        pub uncovered_fraction: f64 where { unit: "1" },
        /// The largest distance of a point of that surface from the spheres, metres; 0 where all of it is in spheres.
        pub max_uncovered: f64 where { unit: "m" },
    }

    /// How often a check by a level is right. A configuration is in collision where two pieces are in contact whose links
    /// are not skipped, and free otherwise; the level touches where spheres are in contact of two links that are neither
    /// skipped nor ignored.
    pub struct SphereEvaluation {
        /// Number of configurations in collision.
        pub num_colliding: Count,
        /// Number of these in which the level does not touch.
        pub num_missed: Count,
        /// Number of free configurations.
        pub num_free: Count,
        /// Number of these in which the level touches.
        pub num_false_contacts: Count,
    }
}

impl SphereEvaluation {
    /// The proportion of collisions that the level misses.
    pub fn miss_rate(&self) -> Rate {
        Rate::new(self.num_missed.0, self.num_colliding.0)
    }

    /// The proportion of free configurations in which the level touches.
    pub fn false_contact_rate(&self) -> Rate {
        Rate::new(self.num_false_contacts.0, self.num_free.0)
    }
}
