//! `self_collision_model_module`: a network that says how near the links of a robot are to each other.

use super::index::{Count, DofIdx, LinkIdx, SampleIdx};
use super::object::{module, object};
use super::root_metadata::Sha256;
use super::tagged::tagged;

module! {
    /// A network that estimates, for a configuration, how near pairs of links are to each other. It is for
    /// passing over configurations that are far from any contact; it guarantees nothing. How often it was wrong
    /// on configurations that it was not trained on is stated.
    pub struct SelfCollisionModelModule {
        /// Of the shapes and the kinematics that it was trained on: SHA-256 of the text that SPEC 8.8.7 defines.
        pub trained_on: Sha256,
        /// Distances from here on were all the same to it, metres.
        pub clip_distance: f64,
        /// What the network is told of a configuration, in the order of its first layer's columns.
        pub inputs: Vec<ModelInput>,
        /// The layers of the network, the first one first. After each but the last, every value is replaced by
        /// its hyperbolic tangent.
        pub layers: Vec<ModelLayer>,
        /// The pairs of links that the network has an output for, in that order.
        pub pairs: Vec<ModelPair>,
        /// The pairs of links that are not skipped and have no output: they were never near in training.
        pub other_pairs: Vec<LinkPair>,
        /// The sampled configurations (SPEC 9.3) that it was trained on.
        pub training: SampleRange,
        /// The sampled configurations that decided when training ended and what the margins are.
        pub calibration: SampleRange,
        /// What came of sampled configurations that had no part in making it.
        pub held_out: HeldOutCounts,
        /// What it gives in some configurations.
        pub test_vectors: Vec<ModelTestVector>,
    }
}

tagged! {
    /// Something that the network is told of a configuration.
    pub enum ModelInput {
        /// Four numbers of an angle q: sin q, cos q, sin 2q, cos 2q.
        Angle(AngleInput),
        /// One number of a length q: (q - middle) / half_range.
        Length(LengthInput),
        /// Nine numbers of a rotation vector: its rotation matrix, row by row.
        RotationVector(RotationVectorInput),
    }
}

object! {
    /// An angle.
    pub struct AngleInput {
        /// The DOF, which is an angle.
        pub dof_idx: DofIdx,
    }
}

object! {
    /// A length.
    pub struct LengthInput {
        /// The DOF, which is a length.
        pub dof_idx: DofIdx,
        /// What becomes 0, metres.
        pub middle: f64,
        /// How far from that is 1, metres; positive.
        pub half_range: f64,
    }
}

object! {
    /// A rotation vector.
    pub struct RotationVectorInput {
        /// Its three DOFs.
        pub dof_idxs: [DofIdx; 3],
    }
}

object! {
    /// A layer of a network: its values are `weights` times the values before, plus `biases`.
    pub struct ModelLayer {
        /// One row for each value of the layer, with one number for each value before it.
        pub weights: Vec<Vec<f64>>,
        /// One number for each value of the layer.
        pub biases: Vec<f64>,
    }
}

object! {
    /// A pair of links that the network has an output for.
    pub struct ModelPair {
        /// One link.
        pub link_a_idx: LinkIdx,
        /// The other, of a higher index.
        pub link_b_idx: LinkIdx,
        /// The clearance of the pair is the network's output less this, metres. A clearance of 0 or less means that the
        /// pair may be in contact.
        pub margin: f64,
    }
}

object! {
    /// A pair of links.
    pub struct LinkPair {
        /// One link.
        pub link_a_idx: LinkIdx,
        /// The other, of a higher index.
        pub link_b_idx: LinkIdx,
    }
}

object! {
    /// Sampled configurations (SPEC 9.3) that follow each other.
    pub struct SampleRange {
        /// The first.
        pub first_sample_idx: SampleIdx,
        /// How many.
        pub num_configurations: Count,
    }
}

object! {
    /// How often the model was right on sampled configurations that follow each other. A configuration is in
    /// collision where a pair of links in `pairs` or `other_pairs` is in contact; the model clears it where no
    /// clearance is 0 or less.
    pub struct HeldOutCounts {
        /// The first configuration.
        pub first_sample_idx: SampleIdx,
        /// How many there are.
        pub num_configurations: Count,
        /// How many of them are in collision.
        pub num_colliding: Count,
        /// How many of those the model clears all the same: the misses.
        pub num_missed: Count,
        /// How many configurations without a collision the model clears.
        pub num_cleared: Count,
    }
}

object! {
    /// What the model gives in a configuration.
    pub struct ModelTestVector {
        /// One value for each DOF, rad or m.
        pub configuration: Vec<f64>,
        /// One clearance for each entry of `pairs`, metres.
        pub clearances: Vec<f64>,
    }
}
