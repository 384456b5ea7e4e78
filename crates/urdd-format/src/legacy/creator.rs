//! `creator_module`, without a version: how a chain was assembled from mesh files.
//!
//! Our copy of the published robots contains no such module. Its structure is known from the
//! converter that reads it, and from a published environment. That environment uses words for the
//! first four actions that were replaced later; both forms are accepted.

use super::urdf::{Axis, JointType, Limit};
use crate::types::module;

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
