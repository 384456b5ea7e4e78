//! The kinematic tree. `dof_module`: the degrees of freedom, and how they determine the joint values. `chain_module`:
//! the kinematic tree, with all data for forward kinematics. `connections_module`: the path between any two links.
//! `kinematics_samples_module`: reference values for forward kinematics. Rigid transforms.

use crate::index::{Count, DofIdx, JointIdx, LinkIdx, SampleIdx};
use crate::types::{module, types};
use crate::urdf::JointType;

types! {
    /// A rigid transform: where a frame lies, and how it is turned, seen from another frame.
    /// It takes coordinates of the inner frame to the outer one: `p_outer = R * p_inner + position`.
    pub struct Pose {
        /// Origin of the inner frame in the outer frame, metres: x, y, z.
        pub position: [f64; 3] where { unit: "m" },
        /// Rotation from the inner to the outer frame as a unit quaternion: w, x, y, z, with `w >= 0`.
        pub quaternion_wxyz: [f64; 4] where { unit: "1" },
    }
}

module! {
    /// The robot's degrees of freedom (DOFs), in joint order, and the position of every joint as a
    /// function of them.
    pub struct DofModule {
        /// Number of DOFs: the length of a configuration vector.
        pub num_dofs: Count,
        /// For each DOF, its joint.
        pub dof_idx_to_joint_idx_mapping: Vec<JointIdx> where { length: "dofs" },
        /// For each joint, its DOFs, ascending; empty for fixed and for mimic joints.
        pub joint_idx_to_dof_idxs_mapping: Vec<Vec<DofIdx>> where { length: "joints" },
        /// For each joint, how it follows a DOF if it is a mimic joint, else null. Chains of mimics
        /// are resolved.
        pub joint_idx_to_mimic_mapping: Vec<Option<ResolvedMimic>> where { length: "joints" },
        /// What each DOF is.
        pub dofs: Vec<Dof> where { length: "dofs" },
    }

    /// What a mimic joint's position is: `multiplier * q[dof_idx] + offset`.
    pub struct ResolvedMimic {
        /// The DOF that drives the joint; null where the chain of mimics ends in a fixed joint,
        /// and the position is `offset` at all times.
        pub dof_idx: Option<DofIdx>,
        /// Factor: the product of the factors along the chain of mimics.
        pub multiplier: f64 where { unit: "1 or rad/m or m/rad" },
        /// Offset, rad or m, accumulated along the chain of mimics.
        pub offset: f64 where { unit: "rad or m" },
    }

    /// A degree of freedom.
    pub struct Dof {
        /// Name: the joint's name where the joint has one DOF; else that name, a slash, and
        /// `trans_x`, `trans_y`, `trans_z`, `rot_x`, `rot_y`, `rot_z` or (planar) `rot`.
        pub name: String,
        /// The joint that it moves.
        pub joint_idx: JointIdx,
        /// Name of that joint.
        pub joint_name: String,
        /// What it measures.
        pub quantity: Quantity,
    }

    /// What a DOF measures.
    pub enum Quantity {
        /// An angle, or a component of a rotation vector: radians.
        Angle,
        /// A length: metres.
        Length,
    }
}

module! {
    /// The kinematic tree: who is whose parent, and where each joint sits and how it moves. With
    /// `dof_module`, this is all that forward kinematics needs.
    pub struct ChainModule {
        /// Every link, in link order.
        pub links_in_chain: Vec<LinkInChain> where { length: "links" },
        /// Every joint, in joint order.
        pub joints_in_chain: Vec<JointInChain> where { length: "joints" },
        /// Links by their depth below the root: level 0 is the root alone; each level ascending.
        pub kinematic_hierarchy: Vec<Vec<LinkIdx>>,
        /// The one link without a parent.
        pub root_idx: LinkIdx,
    }

    /// A link, with its neighbours.
    pub struct LinkInChain {
        /// Name of the link.
        pub name: String,
        /// Its own index: its place in this list.
        pub link_idx: LinkIdx,
        /// The joint that moves it; null for the root.
        pub parent_joint_idx: Option<JointIdx>,
        /// The link that this joint sits on; null for the root.
        pub parent_link_idx: Option<LinkIdx>,
        /// The joints that sit on this link, ascending.
        pub children_joint_idxs: Vec<JointIdx>,
        /// The links that these joints move, ascending.
        pub children_link_idxs: Vec<LinkIdx>,
    }

    /// A joint, with its two links and its motion.
    pub struct JointInChain {
        /// Name of the joint.
        pub joint_name: String,
        /// Its own index: its place in this list.
        pub joint_idx: JointIdx,
        /// Name of the link that carries it.
        pub parent_link_name: String,
        /// That link.
        pub parent_link_idx: LinkIdx,
        /// Name of the link that it moves.
        pub child_link_name: String,
        /// That link.
        pub child_link_idx: LinkIdx,
        /// How it moves.
        pub joint_type: JointType,
        /// Pose of the joint's frame in the parent link's frame. At the zero position the child
        /// link's frame is the joint's frame.
        pub origin: Pose where { frame: "parent_link" },
        /// Unit axis in the joint's frame; for a planar joint the plane's normal. Null for fixed,
        /// floating and spherical joints, which have none.
        pub axis: Option<[f64; 3]> where { unit: "1", frame: "joint" },
    }
}

module! {
    /// Paths through the kinematic tree. The path from link i to link j climbs from i to their lowest
    /// common ancestor and goes down to j, so two slices of `root_paths` give it.
    pub struct ConnectionsModule {
        /// For each link, the path to it from the root.
        pub root_paths: Vec<LinkPath> where { length: "links" },
        /// Element (i, j) is the lowest link that lies above (or is) both i and j.
        pub lowest_common_ancestors: Vec<Vec<LinkIdx>> where { square: "links" },
        /// Element (i, j) is the path from link i to link j. May be null above 300 links, and where
        /// the paths hold more than 2,000,000 links together.
        pub link_to_link_paths: Option<Vec<Vec<LinkPath>>> where { square: "links" },
        /// Element (i, j), where j is a descendant of i: the links from i (exclusive) to j (inclusive);
        /// where i is j: `[i]`; else null. The whole may be null where `link_to_link_paths` may.
        pub link_connection_paths: Option<Vec<Vec<Option<Vec<LinkIdx>>>>> where { square: "links" },
    }

    /// A path through the kinematic tree.
    pub struct LinkPath {
        /// The links along the path, both ends included.
        pub links: Vec<LinkIdx>,
        /// The joints between them: one fewer than `links`.
        pub joints: Vec<JointIdx>,
    }
}

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
