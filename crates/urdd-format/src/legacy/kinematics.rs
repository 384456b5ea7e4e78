//! Legacy modules of the kinematic tree: `bounds_module`, `chain_module`, `connections_module`, and `dof_module`, whose two
//! versions have the same structure.

use crate::index::{Count, DofIdx, JointIdx, LinkIdx};
use crate::types::module;

module! {
    /// Bounds of the configuration space, per DOF: rad or m. Taken from the joint's limit; where its
    /// two ends are equal the upper one is written 1e-7 higher, so that a continuous joint without
    /// limits has [0, 1e-7]. Every DOF of a floating joint repeats the joint's one limit.
    pub struct BoundsModule {
        /// Lower and upper bound of each DOF.
        pub bounds: Vec<[f64; 2]>,
        /// Lower bound of each DOF: the first elements of `bounds`.
        pub dof_lower_bounds: Vec<f64>,
        /// Upper bound of each DOF: the second elements of `bounds`.
        pub dof_upper_bounds: Vec<f64>,
    }
}

module! {
    /// The kinematic tree: who is whose parent.
    pub struct ChainModule {
        /// Every link, in link order.
        pub links_in_chain: Vec<LinkInChain>,
        /// Every joint, in joint order.
        pub joints_in_chain: Vec<JointInChain>,
        /// Links by their depth below the root: level 0 is the root alone.
        pub kinematic_hierarchy: Vec<Vec<LinkIdx>>,
        /// The link without a parent.
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
        /// The joints that sit on this link.
        pub children_joint_idxs: Vec<JointIdx>,
        /// The links that these joints move.
        pub children_link_idxs: Vec<LinkIdx>,
    }

    /// A joint, with its two links.
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
    }
}

module! {
    /// Paths from links down to their descendants.
    pub struct ConnectionsModule {
        /// Element (i, j), where link j is a descendant of link i: the links from i (left out) to j
        /// (included); where i is j: `[i]`; else null.
        pub link_connection_paths: Vec<Vec<Option<Vec<LinkIdx>>>>,
    }
}

module! {
    /// The robot's degrees of freedom (DOFs), in joint order. Revolute, continuous and prismatic
    /// joints have one, planar and spherical ones three, floating ones six. In version 0.0.1 a mimic
    /// joint has DOFs of its own; in 0.0.2 it has none, and its position must be worked out from
    /// `urdf_module`.
    pub struct DofModule {
        /// Number of DOFs: the length of a configuration vector.
        pub num_dofs: Count,
        /// For each DOF, its joint.
        pub dof_idx_to_joint_idx_mapping: Vec<JointIdx>,
        /// For each joint, its DOFs, ascending; empty for a joint without any.
        pub joint_idx_to_dof_idxs_mapping: Vec<Vec<DofIdx>>,
    }
}
