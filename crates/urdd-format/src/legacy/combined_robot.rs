//! `combined_robot_module`, without a version: how a robot was composed of others.

use super::urdf::{Axis, Dynamics, JointType, Limit, Origin, SafetyController};
use crate::index::RobotIdx;
use crate::types::module;

module! {
    /// How this robot was put together: robots that are attached in order, each by a joint. Link and
    /// joint names of robot i get the prefix `robot_i_`.
    pub struct CombinedRobotModule {
        /// Name of this robot.
        pub name: String,
        /// The robots, in the order in which they were attached. The place in this list is the robot
        /// index.
        pub attached_robots: Vec<AttachedRobot>,
    }

    /// A robot, and the joint that attaches its root link.
    pub struct AttachedRobot {
        /// Name of the robot: its folder, beside this one's.
        pub robot_name: String,
        /// What it is attached to.
        pub attachment_point: AttachmentPoint,
        /// How the joint moves.
        pub joint_type: JointType,
        /// Pose of the robot's root link, at zero, in the frame of what it is attached to.
        pub origin: Origin,
        /// The joint's axis. Not carried over into the combined `urdf_module`.
        pub axis: Axis,
        /// The joint's limits.
        pub limit: Limit,
        /// The joint's damping and friction.
        pub dynamics: Option<Dynamics>,
        /// The joint's soft limits.
        pub safety_controller: Option<SafetyController>,
    }

    /// What a robot is attached to.
    pub enum AttachmentPoint {
        /// The link that stands for the world.
        World,
        /// A link of a robot that was attached before.
        Link(RobotLink),
    }

    /// A link of an attached robot.
    pub struct RobotLink {
        /// The robot.
        pub robot_idx: RobotIdx,
        /// Name of the link in that robot, without a prefix.
        pub link_name: String,
    }
}
