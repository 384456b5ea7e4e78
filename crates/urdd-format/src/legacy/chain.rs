//! `chain_module` 0.0.1: the kinematic tree.

use crate::index::{JointIdx, LinkIdx};
use crate::types::module;

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
