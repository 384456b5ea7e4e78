//! The robot to train a model for, how much, the network's inputs for it, and why there may be no model.

use std::collections::BTreeSet;

use thiserror::Error;

use urdd_directory::cancellation::Cancelled;
use urdd_format::chain::ChainModule;
use urdd_format::dof::{DofModule, Quantity};
use urdd_format::escape;
use urdd_format::index::DofIdx;
use urdd_format::root_metadata::Sha256;
use urdd_format::self_collision_model::{AngleInput, LengthInput, ModelInput, RotationVectorInput};
use urdd_format::urdf::JointType;
use urdd_geometry::convex::BodyPairs;
use urdd_kinematics::{ConfigurationError, ConfigurationSpace, ForwardKinematics};

/// Configurations in one block of work.
pub(super) const BLOCK: usize = 64;

/// Distances are clipped at this fraction of the largest distance between two hulls.
const CLIP: f64 = 1.0 / 16.0;

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

/// The network's inputs: the DOFs that move the links of a pair relative to each other. Fails if a length among them has no
/// limits.
pub(super) fn model_inputs(subject: &Subject) -> Result<Vec<ModelInput>, NoModel> {
    let pairs = subject.pairs.bodies();
    let dofs: BTreeSet<usize> =
        pairs.flat_map(|[a, b]| subject.kinematics.dofs_between(a, b)).collect();
    let mut inputs = Vec::new();
    let mut turned: BTreeSet<usize> = BTreeSet::new();
    for dof in dofs {
        let of = &subject.dof.dofs[dof];
        let joint = of.joint_idx.get();
        let dof_idx = DofIdx(u32::try_from(dof).unwrap_or(u32::MAX));
        match (of.quantity, subject.chain.joints_in_chain[joint].joint_type) {
            (Quantity::Length, JointType::Floating | JointType::Planar) => {
                let name = escape::line(&of.name);
                let useless = format!("DOF `{name}` is a length without limits");
                return Err(NoModel::OfNoUse(useless));
            }
            (Quantity::Length, _) => {
                let [lower, upper] = subject.space.bounds()[dof];
                let half_range = rounded(0.5 * (upper - lower).abs());
                inputs.push(ModelInput::Length(LengthInput {
                    dof_idx,
                    middle: rounded(0.5 * lower + 0.5 * upper),
                    half_range: if half_range > 0.0 { half_range } else { 1.0 },
                }));
            }
            (Quantity::Angle, JointType::Floating | JointType::Spherical) => {
                let dofs = &subject.dof.joint_idx_to_dof_idxs_mapping[joint];
                if let (true, Some(dof_idxs)) = (turned.insert(joint), dofs.last_chunk()) {
                    let dof_idxs = *dof_idxs;
                    inputs.push(ModelInput::RotationVector(RotationVectorInput { dof_idxs }));
                }
            }
            (Quantity::Angle, _) => inputs.push(ModelInput::Angle(AngleInput { dof_idx })),
        }
    }
    Ok(inputs)
}

/// How much to train.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// Number of sampled configurations for training.
    pub training: u32,
    /// Number of sampled configurations for choosing margins and for early stopping.
    pub calibration: u32,
    /// Maximum number of epochs.
    pub epochs: u32,
}

impl Default for Effort {
    fn default() -> Self {
        Self { training: 80_000, calibration: 20_000, epochs: 20 }
    }
}

impl Effort {
    /// The first sampled configuration of each part and its count. The parts follow each other from 0.
    pub(super) fn ranges(self) -> [[u32; 2]; 2] {
        [[0, self.training], [self.training, self.calibration]]
    }
}
