//! Counting how often a model is right: SPEC 8.8.9.

use rayon::prelude::*;

use super::network::Network;
use super::pairs;
use crate::document::urdd::Urdd;
use crate::format::self_collision_model::{HeldOutCounts, SelfCollisionModelModule};
use crate::geometry::convex::BodyPairs;
use crate::validate::distances::poses::Poses;
use crate::validate::skip::SkipReason;
use crate::validate::solids::Solids;

/// A count may be off by one for every so many configurations.
pub const PER_TOLERANCE: u32 = 10_000;

/// The work that a validation does by default: about a second of one core. The unit is a nanosecond.
const DEFAULT: u64 = 1_000_000_000;
/// The work with `--deep`. It bounds what a number in a document can ask for.
const DEEP: u64 = 600_000_000_000;

/// What a model and exact distances are compared by.
pub struct Judge {
    network: Network,
    poses: Poses,
    pieces: BodyPairs,
    /// What a configuration costs.
    cost: u64,
}

/// What came of some configurations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Found {
    /// How many there are.
    pub configurations: u64,
    /// In collision.
    pub colliding: u64,
    /// In collision, and cleared by the model.
    pub missed: u64,
    /// Free, and cleared by the model.
    pub cleared: u64,
}

impl Found {
    /// How many are free of collisions.
    pub fn free(&self) -> u64 {
        self.configurations - self.colliding
    }
}

impl From<&HeldOutCounts> for Found {
    fn from(stated: &HeldOutCounts) -> Self {
        Self {
            configurations: stated.num_configurations.0.into(),
            colliding: stated.num_colliding.0.into(),
            missed: stated.num_missed.0.into(),
            cleared: stated.num_cleared.0.into(),
        }
    }
}

impl Judge {
    /// Of a model in which the rules before found no fault.
    ///
    /// # Errors
    /// Why it cannot be compared.
    pub fn new(
        urdd: &Urdd,
        solids: &Solids,
        model: &SelfCollisionModelModule,
    ) -> Result<Self, SkipReason> {
        let poses = Poses::new(urdd)?;
        let pieces = pairs::pieces(urdd, solids)?;
        let numbers: usize = model.layers.iter().map(|of| of.biases.len()).sum();
        let weights = model.layers.iter().flat_map(|of| &of.weights);
        let weights: usize = weights.map(Vec::len).sum();
        let work = 50 * poses.num_links() + 4 * pieces.num_shape_pairs() + 20 * numbers + weights;
        Ok(Self {
            network: Network::new(model),
            poses,
            pieces,
            cost: 2_000 + work as u64,
        })
    }

    /// How many of so many configurations can be looked at.
    pub fn affordable(&self, count: u32, deep: bool) -> u32 {
        let budget = if deep { DEEP } else { DEFAULT };
        let most = u32::try_from(budget / self.cost).unwrap_or(u32::MAX);
        count.min(most)
    }

    /// What comes of so many sampled configurations from the first on; after 2^32 - 1 comes 0.
    ///
    /// # Errors
    /// Where one has no poses.
    pub fn count(&self, first: u32, count: u32) -> Result<Found, SkipReason> {
        let one = |k: u32| {
            let (configuration, poses) = self.poses.sampled(first.wrapping_add(k))?;
            let collides = self.pieces.any_touches(&poses);
            let clears = self.network.clears(&configuration);
            Ok(Found {
                configurations: 1,
                colliding: u64::from(collides),
                missed: u64::from(collides && clears),
                cleared: u64::from(!collides && clears),
            })
        };
        let add = |a: Found, b: Found| Found {
            configurations: a.configurations + b.configurations,
            colliding: a.colliding + b.colliding,
            missed: a.missed + b.missed,
            cleared: a.cleared + b.cleared,
        };
        let all = (0..count).into_par_iter().map(one);
        all.try_reduce(Found::default, |a, b| Ok(add(a, b)))
    }
}
