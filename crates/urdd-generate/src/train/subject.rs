//! The robot to train a model for, and why there may be no model.

use thiserror::Error;

use super::settings::Effort;
use urdd_directory::cancellation::Cancelled;
use urdd_format::root_metadata::Sha256;
use urdd_format::self_collision_model::ModelInput;
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};

pub struct Subject<'a> {
    pub kinematics: &'a ForwardKinematics,
    pub space: &'a ConfigurationSpace,
    /// The network's inputs: the DOFs that move the links of a pair relative to each other.
    pub inputs: Vec<ModelInput>,
    /// The pairs of links that are not skipped. The bodies are link indices.
    pub pairs: &'a BodyPairs,
    /// The distance in metres from which all distances count as equal.
    pub clip_distance: f64,
    /// Digest of the shapes and the kinematics.
    pub trained_on: Sha256,
    pub effort: Effort,
}

#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoModel {
    /// A model would be of no use for this robot: why.
    #[error("{0}")]
    OfNoUse(String),
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
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
