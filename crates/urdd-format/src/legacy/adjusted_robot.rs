//! `adjusted_robot_module`, without a version: how a robot was trimmed from another.

use crate::index::{JointIdx, LinkIdx};
use crate::types::module;

module! {
    /// How this robot was made from another (the base robot) by cutting branches off and fixing joints.
    pub struct AdjustedRobotModule {
        /// Name of this robot.
        pub name: String,
        /// Name of the base robot: its folder, beside this one's.
        pub base_robot_name: String,
        /// Links of the base robot that were cut off, each with everything below it.
        pub dead_end_link_names: Vec<String>,
        /// Joints of the base robot that were made fixed: name, and the value of each of its DOFs
        /// (rad or m), which went into the joint's origin.
        pub fixed_base_joints: Vec<(String, Vec<f64>)>,
        /// Every link of the base robot that is gone.
        pub deleted_base_links: Vec<String>,
        /// Every joint of the base robot that is gone.
        pub deleted_base_joints: Vec<String>,
        /// For each link of this robot, its index in the base robot.
        pub adjusted_link_idx_to_base_link_idx_mapping: Vec<LinkIdx>,
        /// For each link of the base robot, its index in this one; null if it is gone.
        pub base_link_idx_to_adjusted_link_idx_mapping: Vec<Option<LinkIdx>>,
        /// For each joint of this robot, its index in the base robot.
        pub adjusted_joint_idx_to_base_joint_idx_mapping: Vec<JointIdx>,
        /// For each joint of the base robot, its index in this one; null if it is gone.
        pub base_joint_idx_to_adjusted_joint_idx_mapping: Vec<Option<JointIdx>>,
    }
}
