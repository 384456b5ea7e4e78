//! The robot to train a model for, and why there may be no model.

use thiserror::Error;

use super::settings::{CLIP, Effort};
use urdd_directory::cancellation::Cancelled;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::root_metadata::Sha256;
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};

/// Configurations in one block of work.
pub(super) const BLOCK: usize = 64;

/// The robot to train a model for.
pub struct Subject<'a> {
    /// Its links and joints.
    pub chain: &'a ChainModule,
    /// Its DOFs.
    pub dof: &'a DofModule,
    /// The kinematics of these two.
    pub kinematics: &'a ForwardKinematics,
    /// Its configurations.
    pub space: &'a ConfigurationSpace,
    /// The pairs of links that are not skipped. The bodies are link indices.
    pub pairs: &'a BodyPairs,
    /// The largest distance between two links' hulls, metres.
    pub largest_distance: f64,
    /// Digest of the shapes and the kinematics.
    pub trained_on: Sha256,
    /// How much to train.
    pub effort: Effort,
}

impl Subject<'_> {
    /// The distance in metres from which all distances count as equal.
    pub(super) fn clip_distance(&self) -> f64 {
        rounded(CLIP * self.largest_distance)
    }

    /// `count` sampled configurations from `first` on, one after another.
    pub(super) fn configurations(&self, [first, count]: [u32; 2]) -> Vec<f64> {
        (0..count).flat_map(|k| self.space.sampled(u64::from(first) + u64::from(k))).collect()
    }
}

/// Rounds to seven significant digits, the precision of numbers in a document.
pub(super) fn rounded(number: f64) -> f64 {
    format!("{number:.6e}").parse().unwrap_or(number)
}

/// Why there is no model.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoModel {
    /// A model would be of no use for this robot: why.
    #[error("{0}")]
    OfNoUse(String),
    /// A configuration without link poses.
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
    /// Training was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl NoModel {
    /// Checks that at least `least` of the sampled configurations collide, and that as many are free.
    pub(super) fn check_counts(colliding: usize, of: usize, least: usize) -> Result<(), Self> {
        let few = |found: usize, state: &str| {
            NoModel::OfNoUse(format!(
                "{found} of {of} sampled configurations are {state}, which is too few to learn from"
            ))
        };
        match (colliding, of - colliding) {
            (found, _) if found < least => Err(few(found, "in collision")),
            (_, found) if found < least => Err(few(found, "free of collisions")),
            _ => Ok(()),
        }
    }
}
