//! Counts how often a model is right: SPEC 8.8.9 and 8.8.10.

use rayon::prelude::*;

use super::network::Network;
use super::pairs;
use crate::reference::budget::Budget;
use crate::reference::distances::poses::Poses;
use crate::skip;
use crate::solids::Solids;
use urdd_document::urdd::Urdd;
use urdd_findings::skip::SkipReason;
use urdd_format::index::Count;
use urdd_format::self_collision_model::{
    EVALUATION_FIRST, ModelEvaluation, NEAR_CONTACT_STEP, SelfCollisionModelModule,
};
use urdd_geometry::convex::BodyPairs;

/// Average work allowed per configuration, so that counting takes at most about 20 seconds on one core. The unit is
/// about a nanosecond.
const DEFAULT: u64 = 200_000;
/// The same with `--deep`: about 7 minutes.
const DEEP: u64 = 4_000_000;
/// Work of comparing two pieces whose bounding spheres intersect, of the unit that `DEFAULT` has.
pub const COMPARISON: u64 = 150;
/// A count may differ by one per this many configurations that it is counted among.
pub const PER_TOLERANCE: u32 = 10_000;

/// Compares a model with exact geometry.
pub struct Judge {
    network: Network,
    poses: Poses,
    pieces: BodyPairs,
    /// Work of a configuration, without comparing pieces.
    cost: u64,
    /// Average work allowed per configuration.
    budget: u64,
    deep: bool,
}

impl Judge {
    /// For a model in which the rules before found no fault. `deep` allows more work.
    ///
    /// # Errors
    /// Why the model cannot be compared.
    pub fn new(
        urdd: &Urdd,
        solids: &Solids,
        model: &SelfCollisionModelModule,
        deep: bool,
    ) -> Result<Self, SkipReason> {
        let poses = Poses::new(urdd)?;
        let pieces = pairs::pieces(urdd, solids)?;
        let numbers: usize = model.layers.iter().map(|of| of.biases.len()).sum();
        let weights: usize = model.layers.iter().flat_map(|of| &of.weights).map(Vec::len).sum();
        let work = 50 * poses.num_links() + 4 * pieces.num_shape_pairs() + 20 * numbers + weights;
        Ok(Self {
            network: Network::new(model),
            poses,
            pieces,
            cost: 2_000 + work as u64,
            budget: if deep { DEEP } else { DEFAULT },
            deep,
        })
    }

    /// Counts over sampled configurations, from the first one on. Collisions near contact are determined for those of
    /// the evaluation only.
    ///
    /// # Errors
    /// If a configuration has no poses, or the work exceeds the limit. The sum of all work decides, independent of the
    /// machine and of the number of threads.
    pub fn count(&self, first: u32, count: u32) -> Result<ModelEvaluation, SkipReason> {
        let most = self.budget.saturating_mul(u64::from(count));
        let budget = Budget::of(most, skip::counting_takes_too_long(self.deep));
        let one = |k: u32| {
            let (found, work) = self.judge(first.wrapping_add(k), first == EVALUATION_FIRST)?;
            budget.spend(work)?;
            Ok(found)
        };
        let all = (0..count).into_par_iter().map(one);
        all.try_reduce(|| ModelEvaluation::NOTHING, |a, b| Ok(sum(a, b)))
    }

    /// The counts of one configuration, and the work that it took.
    fn judge(&self, sample: u32, near_contact: bool) -> Result<(ModelEvaluation, u64), SkipReason> {
        let (configuration, poses) = self.poses.sampled(sample)?;
        let (collides, compared) = self.pieces.any_touches_and_work(&poses);
        let mut work = self.cost + COMPARISON * compared as u64;
        let cleared = u32::from(self.network.clears(&configuration));
        let mut found = ModelEvaluation::NOTHING;
        if !collides {
            found.num_free.0 = 1;
            found.num_cleared.0 = cleared;
            return Ok((found, work));
        }
        found.num_colliding.0 = 1;
        found.num_missed.0 = cleared;
        if near_contact {
            let (next, _) = self.poses.sampled(sample.wrapping_add(1))?;
            let poses = self.poses.of(&stepped(&configuration, &next))?;
            let (collides, compared) = self.pieces.any_touches_and_work(&poses);
            work += self.cost + COMPARISON * compared as u64;
            if !collides {
                found.num_near_contact.0 = 1;
                found.num_near_contact_missed.0 = cleared;
            }
        }
        Ok((found, work))
    }
}

/// SPEC 8.8.10: steps towards the next configuration, until a DOF has changed by 0.05 or the next is reached.
pub fn stepped(from: &[f64], next: &[f64]) -> Vec<f64> {
    let differences: Vec<f64> = next.iter().zip(from).map(|(b, a)| b - a).collect();
    let largest = differences.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
    let scale = (NEAR_CONTACT_STEP / largest).min(1.0);
    let moved = from.iter().zip(&differences).map(|(a, d)| a + scale * d);
    moved.collect()
}

fn sum(a: ModelEvaluation, b: ModelEvaluation) -> ModelEvaluation {
    let add = |a: Count, b: Count| Count(a.0 + b.0);
    ModelEvaluation {
        num_colliding: add(a.num_colliding, b.num_colliding),
        num_missed: add(a.num_missed, b.num_missed),
        num_near_contact: add(a.num_near_contact, b.num_near_contact),
        num_near_contact_missed: add(a.num_near_contact_missed, b.num_near_contact_missed),
        num_free: add(a.num_free, b.num_free),
        num_cleared: add(a.num_cleared, b.num_cleared),
    }
}
