//! `self_collision_model_module`: a network that estimates the distances between a robot's links.

use super::index::{Count, DofIdx, LinkIdx, SampleIdx};
use super::rate::Rate;
use super::root_metadata::Sha256;
use super::types::{module, types};

/// First sampled configuration that `evaluation` counts (SPEC 8.8.9). Models are made from earlier ones only.
pub const EVALUATION_FIRST: u32 = 1 << 31;
/// Number of sampled configurations that `evaluation` counts.
pub const EVALUATION_COUNT: u32 = 50_000;
/// Minimum number in `evaluation` of configurations in collision, and also of free ones.
pub const EVALUATION_MIN: u32 = 200;
/// First sampled configuration of the first confirmation (SPEC 8.8.12).
pub const CONFIRMATION_FIRST: u32 = (1 << 31) + (1 << 20);
/// Earliest start of the second confirmation. The model's numbers determine an offset below 2^29.
pub const CONFIRMATION_SECOND: u32 = (1 << 31) + (1 << 30);
/// Number of sampled configurations of each confirmation.
pub const CONFIRMATION_COUNT: u32 = 25_000;
/// A configuration in collision is near contact if a step of this size frees it, rad or m (SPEC 8.8.10).
pub const NEAR_CONTACT_STEP: f64 = 0.05;

module! {
    /// A network that estimates, for a configuration, how near pairs of links are to each other. It is for
    /// passing over configurations that are far from any contact. It is an estimate, not a guarantee: `evaluation`
    /// says how often it is wrong.
    pub struct SelfCollisionModelModule {
        /// Of the shapes and the kinematics that it was trained on: SHA-256 of the text that SPEC 8.8.7 defines.
        pub trained_on: Sha256,
        /// Distances from here on were all the same to it, metres.
        pub clip_distance: f64 where { unit: "m" },
        /// What the network is told of a configuration, in the order of its first layer's columns.
        pub inputs: Vec<ModelInput>,
        /// The layers of the network, the first one first. After each but the last, every value is replaced by
        /// its hyperbolic tangent.
        pub layers: Vec<ModelLayer>,
        /// The pairs of links that the network has an output for, in that order.
        pub pairs: Vec<ModelPair> where { length: "pairs" },
        /// The pairs of links that are not skipped and have no output: they were never near in training.
        pub other_pairs: Vec<LinkPair>,
        /// The sampled configurations (SPEC 9.3) that it was trained on.
        pub training: SampleRange,
        /// The sampled configurations that decided when training ended and what the margins are.
        pub calibration: SampleRange,
        /// How often it is right on the sampled configurations that SPEC 8.8.9 fixes.
        pub evaluation: ModelEvaluation,
        /// What it gives in some configurations.
        pub test_vectors: Vec<ModelTestVector>,
    }

    /// Something that the network is told of a configuration.
    pub enum ModelInput {
        /// Four numbers of an angle q: sin q, cos q, sin 2q, cos 2q.
        Angle(AngleInput),
        /// One number of a length q: (q - middle) / half_range.
        Length(LengthInput),
        /// Nine numbers of a rotation vector: its rotation matrix, row by row.
        RotationVector(RotationVectorInput),
    }

    /// An angle.
    pub struct AngleInput {
        /// The DOF, which is an angle.
        pub dof_idx: DofIdx,
    }

    /// A length.
    pub struct LengthInput {
        /// The DOF, which is a length.
        pub dof_idx: DofIdx,
        /// What becomes 0, metres.
        pub middle: f64 where { unit: "m" },
        /// How far from that is 1, metres; positive.
        pub half_range: f64 where { unit: "m" },
    }

    /// A rotation vector.
    pub struct RotationVectorInput {
        /// Its three DOFs.
        pub dof_idxs: [DofIdx; 3],
    }

    /// A layer of a network: its values are `weights` times the values before, plus `biases`.
    pub struct ModelLayer {
        /// One row for each value of the layer, with one number for each value before it.
        pub weights: Vec<Vec<f64>> where { unit: "1 or m" },
        /// One number for each value of the layer.
        pub biases: Vec<f64> where { unit: "1 or m" },
    }

    /// A pair of links that the network has an output for.
    pub struct ModelPair {
        /// One link.
        pub link_a_idx: LinkIdx,
        /// The other, of a higher index.
        pub link_b_idx: LinkIdx,
        /// The clearance of the pair is the network's output less this, metres. A clearance of 0 or less means that the
        /// pair may be in contact.
        pub margin: f64 where { unit: "m" },
    }

    /// A pair of links.
    pub struct LinkPair {
        /// One link.
        pub link_a_idx: LinkIdx,
        /// The other, of a higher index.
        pub link_b_idx: LinkIdx,
    }

    /// Sampled configurations (SPEC 9.3) that follow each other.
    pub struct SampleRange {
        /// The first.
        pub first_sample_idx: SampleIdx,
        /// How many.
        pub num_configurations: Count,
    }

    /// How often the model is right on the sampled configurations 2^31 to 2^31 + 49,999, which have no part in making
    /// any model. A configuration is in collision where a pair of links in `pairs` or `other_pairs` is in contact, and
    /// free otherwise. The model clears a configuration where every clearance is above 0.
    pub struct ModelEvaluation {
        /// Number of configurations in collision.
        pub num_colliding: Count,
        /// Number of these that the model clears: the misses.
        pub num_missed: Count,
        /// Number of configurations in collision that are near contact: a step of at most 0.05 rad or 0.05 m in each
        /// DOF makes them free (SPEC 8.8.10).
        pub num_near_contact: Count,
        /// Number of these that the model clears.
        pub num_near_contact_missed: Count,
        /// Number of free configurations.
        pub num_free: Count,
        /// Number of these that the model clears.
        pub num_cleared: Count,
    }
}

impl ModelEvaluation {
    /// An evaluation without configurations.
    pub const NOTHING: ModelEvaluation = ModelEvaluation {
        num_colliding: Count(0),
        num_missed: Count(0),
        num_near_contact: Count(0),
        num_near_contact_missed: Count(0),
        num_free: Count(0),
        num_cleared: Count(0),
    };

    /// The proportion of collisions that the model misses.
    pub fn miss_rate(&self) -> Rate {
        Rate::new(self.num_missed.0, self.num_colliding.0)
    }

    /// The proportion of near-contact collisions that the model misses.
    pub fn near_contact_miss_rate(&self) -> Rate {
        Rate::new(self.num_near_contact_missed.0, self.num_near_contact.0)
    }

    /// The proportion of free configurations that the model clears.
    pub fn clear_rate(&self) -> Rate {
        Rate::new(self.num_cleared.0, self.num_free.0)
    }
}

types! {
    /// What the model gives in a configuration.
    pub struct ModelTestVector {
        /// One value for each DOF, rad or m.
        pub configuration: Vec<f64> where { unit: "rad or m", length: "dofs" },
        /// One clearance for each entry of `pairs`, metres.
        pub clearances: Vec<f64> where { unit: "m", length: "pairs" },
    }
}
