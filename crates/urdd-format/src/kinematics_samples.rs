//! `kinematics_samples_module`: reference values for forward kinematics.

use super::index::SampleIdx;
use super::pose::Pose;
use super::types::module;

module! {
    /// Configurations, and the pose of every link in each: values by which a consumer in any language
    /// proves its forward kinematics right.
    pub struct KinematicsSamplesModule {
        /// The samples: zero, middle, lower, upper, then sampled ones in order.
        pub samples: Vec<KinematicsSample>,
    }

    /// A configuration, and where every link is then.
    pub struct KinematicsSample {
        /// Which configuration it is.
        pub kind: ConfigurationKind,
        /// The number of a sampled configuration; null for the other kinds.
        pub sample_idx: Option<SampleIdx>,
        /// One value per DOF, rad or m.
        pub configuration: Vec<f64> where { unit: "rad or m", length: "dofs" },
        /// For each link, its frame's pose in the root link's frame.
        pub link_poses: Vec<Pose> where { frame: "root", length: "links" },
    }

    /// A configuration that the specification defines.
    pub enum ConfigurationKind {
        /// Every DOF 0, even where 0 is out of bounds.
        Zero,
        /// Every DOF half-way between its bounds; a rotation vector 0.
        Middle,
        /// Every DOF at its lower bound; a rotation vector (-pi, 0, 0).
        Lower,
        /// Every DOF at its upper bound; a rotation vector (pi, 0, 0).
        Upper,
        /// Number `sample_idx` of the sequence of sampled configurations.
        Sampled,
    }
}
