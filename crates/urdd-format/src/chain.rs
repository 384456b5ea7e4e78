//! `chain_module`: the kinematic tree, with all data for forward kinematics.

use super::index::{JointIdx, LinkIdx};
use super::pose::Pose;
use super::types::module;
use super::urdf::JointType;

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
