//! The robot to train a model for, and why there may be no model.

use thiserror::Error;

use super::settings::Effort;
use urdd_directory::cancellation::Cancelled;
use urdd_format::escape;
use urdd_format::root_metadata::Sha256;
use urdd_format::self_collision_model::ModelInput;
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};

/// The robot to train a model for.
pub struct Subject<'a> {
    /// Its forward kinematics.
    pub kinematics: &'a ForwardKinematics,
    /// Its configuration space.
    pub space: &'a ConfigurationSpace,
    /// The network's inputs: the DOFs that move the links of a pair relative to each other.
    pub inputs: Vec<ModelInput>,
    /// The pairs of links that are not skipped. The bodies are link indices.
    pub pairs: &'a BodyPairs,
    /// The distance in metres from which all distances count as equal.
    pub clip_distance: f64,
    /// Digest of the shapes and the kinematics.
    pub trained_on: Sha256,
    /// How much to train.
    pub effort: Effort,
}

/// Why no model was trained.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoModel {
    /// A model would be of no use for this robot.
    #[error("{0}")]
    OfNoUse(Useless),
    /// A configuration without valid link poses.
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
    /// Training was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Why a model would be of no use for a robot.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Useless {
    /// A length DOF without limits: its sampling range is arbitrary.
    #[error("DOF `{}` is a length without limits", escape::line(.dof))]
    NoLimits {
        /// Name of the DOF.
        dof: String,
    },
    /// No two links that are not skipped move relative to each other.
    #[error("no two links that are not skipped move relative to each other")]
    NothingMoves,
    /// Too many pairs of links.
    #[error(
        "more than {most} pairs of links are not skipped, and a model of so many is no faster than exact distances"
    )]
    ManyPairs {
        /// Maximum number of pairs.
        most: usize,
    },
    /// Too many DOFs.
    #[error("the robot has {found} DOFs, but a model supports at most {most}")]
    ManyDofs {
        /// The number of DOFs.
        found: usize,
        /// Maximum number of DOFs.
        most: usize,
    },
    /// Too few collisions among the samples.
    #[error(
        "{found} of {of} sampled configurations are in collision, which is too few to learn from"
    )]
    FewCollisions {
        /// The number of collisions.
        found: usize,
        /// The number of sampled configurations.
        of: usize,
    },
    /// Too few free configurations.
    #[error(
        "{found} of {of} sampled configurations are free of collisions, which is too few to learn from"
    )]
    FewFree {
        /// The number of free configurations.
        found: usize,
        /// The number of sampled configurations.
        of: usize,
    },
    /// Repeatedly, other configurations did not confirm the model's rates.
    #[error("the rates of {attempts} models were not confirmed on other configurations")]
    NotConfirmed {
        /// The number of trained models.
        attempts: u64,
    },
}
