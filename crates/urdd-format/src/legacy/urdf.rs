//! `urdf_module` 0.0.1 and 0.0.3: the URDF as data. Both versions have the same structure.

use crate::types::module;
// These are as in version 1.
pub use crate::urdf::{Color, Cuboid, Cylinder, LinkName, Mass, Mimic, Sphere, Texture};

module! {
    /// The URDF as data. What the URDF leaves out of an inertial, a limit, an origin or an axis is
    /// written as a default (mostly zeros), so that absent and zero cannot be told apart. Elements
    /// other than links, joints and materials are lost.
    pub struct UrdfModule {
        /// Name of the robot.
        pub name: String,
        /// Links in the order of the file. The place in this list is the link index.
        pub links: Vec<Link>,
        /// Joints in the order of the file. The place in this list is the joint index.
        pub joints: Vec<Joint>,
        /// Materials declared at the top of the file, in its order.
        pub materials: Vec<Material>,
    }

    /// A link: a rigid body.
    pub struct Link {
        /// Name.
        pub name: String,
        /// Mass, centre of mass and inertia; zeros where the URDF has none.
        pub inertial: Inertial,
        /// Visual elements in the order of the file.
        pub visual: Vec<Visual>,
        /// Collision elements in the order of the file.
        pub collision: Vec<Collision>,
    }

    /// Mass properties of a link.
    pub struct Inertial {
        /// Centre of mass, and the axes of `inertia`, in the link's frame.
        pub origin: Origin,
        /// Mass.
        pub mass: Mass,
        /// Inertia tensor about the centre of mass, in the axes of `origin`.
        pub inertia: Inertia,
    }

    /// A pose as the URDF writes it.
    pub struct Origin {
        /// Position, metres: x, y, z.
        pub xyz: [f64; 3],
        /// Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.
        pub rpy: [f64; 3],
    }

    /// The six independent elements of a symmetric inertia tensor, kg m².
    pub struct Inertia {
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

    /// What a link looks like, or a part of it.
    pub struct Visual {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        pub origin: Origin,
        /// Its shape.
        pub geometry: Geometry,
        /// Its material.
        pub material: Option<Material>,
    }

    /// What a link collides with, or a part of it.
    pub struct Collision {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        pub origin: Origin,
        /// Its shape.
        pub geometry: Geometry,
    }

    /// A shape: an object of one key, which says of what kind it is.
    pub enum Geometry {
        /// A mesh file.
        Mesh(Mesh),
        /// A box about the origin.
        Box(Cuboid),
        /// A cylinder about the origin, along z.
        Cylinder(Cylinder),
        /// A capsule about the origin, along z.
        Capsule(Capsule),
        /// A sphere about the origin.
        Sphere(Sphere),
    }

    /// A mesh file.
    pub struct Mesh {
        /// File name as the URDF has it.
        pub filename: String,
        /// Factors along x, y, z; null where the URDF has none. The other modules ignore it.
        pub scale: Option<[f64; 3]>,
    }

    /// A capsule about the origin, along z.
    pub struct Capsule {
        /// Radius, metres.
        pub radius: f64,
        /// Length, metres.
        pub length: f64,
    }

    /// A material, or a reference to one by its name.
    pub struct Material {
        /// Name.
        pub name: String,
        /// Colour.
        pub color: Option<Color>,
        /// Texture.
        pub texture: Option<Texture>,
    }

    /// How a joint moves.
    pub enum JointType {
        /// Turns about its axis, within limits. One DOF, rad.
        Revolute,
        /// Turns about its axis, without limits. One DOF, rad.
        Continuous,
        /// Slides along its axis. One DOF, m.
        Prismatic,
        /// Does not move. No DOF.
        Fixed,
        /// Moves freely. Six DOFs: exponential coordinates of SE(3), rotation (rad), then translation (m).
        Floating,
        /// Slides in a plane. Three DOFs in `dof_module`; the converter's own kinematics takes two,
        /// along x and y of the parent.
        Planar,
        /// Turns freely. Three DOFs: a rotation vector (rad).
        Spherical,
    }

    /// A joint: how one link moves on another.
    pub struct Joint {
        /// Name.
        pub name: String,
        /// How it moves.
        pub joint_type: JointType,
        /// Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.
        pub origin: Origin,
        /// The link that carries the joint.
        pub parent: LinkName,
        /// The link that the joint moves.
        pub child: LinkName,
        /// Axis in the joint's frame, as written: not normalised.
        pub axis: Axis,
        /// Limits; zeros where the URDF has none.
        pub limit: Limit,
        /// Damping and friction.
        pub dynamics: Option<Dynamics>,
        /// The joint that this one follows.
        pub mimic: Option<Mimic>,
        /// Soft limits.
        pub safety_controller: Option<SafetyController>,
    }

    /// The axis of a joint.
    pub struct Axis {
        /// Direction in the joint's frame.
        pub xyz: [f64; 3],
    }

    /// Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones.
    pub struct Limit {
        /// Smallest position.
        pub lower: f64,
        /// Largest position.
        pub upper: f64,
        /// Largest effort.
        pub effort: f64,
        /// Largest speed.
        pub velocity: f64,
    }

    /// Dynamics of a joint.
    pub struct Dynamics {
        /// Damping: N m s/rad, or N s/m.
        pub damping: f64,
        /// Static friction: N m, or N.
        pub friction: f64,
    }

    /// Soft limits of a joint.
    pub struct SafetyController {
        /// Where the controller begins to limit the position, below.
        pub soft_lower_limit: f64,
        /// Where the controller begins to limit the position, above.
        pub soft_upper_limit: f64,
        /// Relation between position and velocity limits.
        pub k_position: f64,
        /// Relation between effort and velocity limits.
        pub k_velocity: f64,
    }
}
