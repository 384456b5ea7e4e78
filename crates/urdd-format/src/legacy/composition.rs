//! Legacy modules, without a version, of robots that were made from others: `adjusted_robot_module`,
//! `combined_robot_module` and `creator_module`.
//!
//! Our copy of the published robots contains no `creator_module`. Its structure is known from the
//! converter that reads it, and from a published environment. That environment uses words for the
//! first four actions that were replaced later; both forms are accepted.

use super::urdf::{Axis, Dynamics, JointType, Limit, Origin, SafetyController};
use crate::index::{JointIdx, LinkIdx, RobotIdx};
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

module! {
    /// How a chain (a robot, or an environment) was put together: actions, in order.
    pub struct CreatorModule {
        /// Name of the chain.
        pub name: String,
        /// The actions.
        pub actions: Vec<Action>,
    }

    /// A step in putting a chain together.
    pub enum Action {
        /// Adds a chain that exists.
        AddAlreadyExistingChain(AddChain),
        /// Adds a chain that exists. An older word.
        AddAlreadyExistingEnvironment(AddChain),
        /// Adds a link from an STL file.
        AddSingleLinkFromStlFile(AddLink),
        /// Adds a link from an OBJ file.
        AddSingleLinkFromObjFile(AddLink),
        /// Adds a link from a glTF file.
        AddSingleLinkFromGlbFile(AddLink),
        /// Adds a link from an STL file. An older word.
        AddSingleObjectFromStlFile(AddLink),
        /// Adds a link from an OBJ file. An older word.
        AddSingleObjectFromObjFile(AddLink),
        /// Adds a link from a glTF file. An older word.
        AddSingleObjectFromGlbFile(AddLink),
        /// Adds a link for each node of a glTF file.
        AddSceneFromGlbFile(AddScene),
        /// Says how a joint moves.
        SetJointType(SetJointType),
        /// Sets the axis of a joint.
        SetJointAxis(SetJointAxis),
        /// Sets the limits of a joint.
        SetJointLimit(SetJointLimit),
        /// Says whether a simulation moves a link.
        SetObjectSimulationMode(SetSimulationMode),
        /// Sets the mass of a link.
        SetObjectMass(SetMass),
        /// Sets the centre of mass of a link.
        SetObjectInertialOrigin(SetInertialOrigin),
        /// Sets the inertia tensor of a link.
        SetObjectInertia(SetInertia),
    }

    /// A pose.
    pub struct Isometry {
        /// Rotation as a unit quaternion: x, y, z, w.
        pub rotation: [f64; 4],
        /// Position, metres: x, y, z.
        pub translation: [f64; 3],
    }

    /// A chain to add.
    pub struct AddChain {
        /// Its name: its folder, beside this one's.
        pub name: String,
        /// Its pose in the world.
        pub base_offset: Isometry,
        /// Factors along x, y, z.
        pub scale: [f64; 3],
    }

    /// A link to add, from a mesh file.
    pub struct AddLink {
        /// Path of the mesh file on the machine where the chain was made.
        pub fp: String,
        /// Name of the link.
        pub object_name: String,
        /// Name of the link that carries it; null for the world.
        pub parent_object: Option<String>,
        /// Its pose in the frame of the link that carries it.
        pub base_offset: Isometry,
        /// Factors along x, y, z.
        pub scale: [f64; 3],
    }

    /// Links to add, from a glTF file.
    pub struct AddScene {
        /// Name of the scene.
        pub scene_name: String,
        /// Path of the file on the machine where the chain was made.
        pub fp: String,
        /// Name of the link that carries the scene; null for the world.
        pub parent_object: Option<String>,
        /// Pose of the scene in the frame of what carries it.
        pub transform: Isometry,
        /// Factors along x, y, z.
        pub scale: [f64; 3],
    }

    /// How a joint moves; the joint is named by its two links.
    pub struct SetJointType {
        /// Name of the parent link; null for the world.
        pub parent_object: Option<String>,
        /// Name of the child link.
        pub child_object: String,
        /// How it moves.
        pub joint_type: JointType,
    }

    /// The axis of a joint; the joint is named by its two links.
    pub struct SetJointAxis {
        /// Name of the parent link; null for the world.
        pub parent_object: Option<String>,
        /// Name of the child link.
        pub child_object: String,
        /// Its axis.
        pub axis: Axis,
    }

    /// The limits of a joint; the joint is named by its two links.
    pub struct SetJointLimit {
        /// Name of the parent link; null for the world.
        pub parent_object: Option<String>,
        /// Name of the child link.
        pub child_object: String,
        /// Its limits.
        pub joint_limit: Limit,
    }

    /// Whether a simulation moves a link.
    pub enum SimulationMode {
        /// It does.
        Active,
        /// It does not.
        Passive,
    }

    /// Whether a simulation moves a link.
    pub struct SetSimulationMode {
        /// Name of the link.
        pub object_name: String,
        /// Whether it moves.
        pub mode: SimulationMode,
    }

    /// The mass of a link.
    pub struct SetMass {
        /// Name of the link.
        pub object_name: String,
        /// Kilograms.
        pub mass: f64,
    }

    /// The centre of mass of a link.
    pub struct SetInertialOrigin {
        /// Name of the link.
        pub object_name: String,
        /// Centre of mass, and the axes of the inertia tensor, in the link's frame.
        pub pose: Isometry,
    }

    /// The inertia tensor of a link, kg m².
    pub struct SetInertia {
        /// Name of the link.
        pub object_name: String,
        /// Element xx.
        pub ixx: f64,
        /// Element xy.
        pub ixy: f64,
        /// Element xz.
        pub ixz: f64,
        /// Element yy.
        pub iyy: f64,
        /// Element yz.
        pub iyz: f64,
        /// Element zz.
        pub izz: f64,
    }
}
