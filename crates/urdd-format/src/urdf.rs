//! `urdf_module`: the complete source URDF as JSON.

use super::types::module;

module! {
    /// The source URDF as data. What the URDF leaves out is null (or an empty list), never a default.
    /// Lengths are metres, angles radians, masses kilograms; rotations are the URDF's own fixed-axis
    /// roll, pitch, yaw. Numbers that are not finite in the URDF are written as null.
    #[derive(Default)]
    pub struct UrdfModule {
        /// Name of the robot (`<robot name>`).
        pub name: String,
        /// The URDF format version that the file states (`<robot version>`).
        pub version: Option<String>,
        /// Links in the order of the file. The place in this list is the link index.
        pub links: Vec<Link> where { length: "links" },
        /// Joints in the order of the file. The place in this list is the joint index.
        pub joints: Vec<Joint> where { length: "joints" },
        /// Materials declared at the top of the file, in its order.
        pub materials: Vec<Material>,
        /// Other elements directly under `<robot>` (transmission, gazebo, ros2_control, …), each as
        /// its own XML text, in the order of the file.
        pub unknown_elements: Vec<String>,
    }

    /// A link: a rigid body.
    pub struct Link {
        /// Name, unique among the links.
        pub name: String,
        /// Mass, centre of mass and inertia.
        pub inertial: Option<Inertial>,
        /// Visual elements in the order of the file.
        pub visual: Vec<Visual>,
        /// Collision elements in the order of the file.
        pub collision: Vec<Collision>,
        /// Other elements directly under `<link>`, each as its own XML text.
        pub unknown_elements: Vec<String>,
    }

    /// Mass properties of a link.
    pub struct Inertial {
        /// Centre of mass, and the axes of `inertia`, in the link's frame.
        pub origin: Option<Origin> where { frame: "link" },
        /// Mass.
        pub mass: Option<Mass>,
        /// Inertia tensor about the centre of mass, in the axes of `origin`.
        pub inertia: Option<Inertia> where { frame: "inertial" },
    }

    /// A pose as the URDF writes it.
    pub struct Origin {
        /// Position, metres: x, y, z.
        pub xyz: Option<[f64; 3]> where { unit: "m" },
        /// Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.
        pub rpy: Option<[f64; 3]> where { unit: "rad" },
        /// Rotation as a quaternion x, y, z, w of any length but zero, instead of `rpy`. It counts
        /// from URDF version 1.1 on; before, it has no meaning.
        pub quat_xyzw: Option<[f64; 4]> where { unit: "1" },
    }

    /// Mass of a link.
    pub struct Mass {
        /// Kilograms.
        pub value: f64 where { unit: "kg" },
    }

    /// The six independent elements of a symmetric inertia tensor, kg m².
    pub struct Inertia {
        /// Element xx.
        pub ixx: Option<f64> where { unit: "kg*m^2" },
        /// Element xy.
        pub ixy: Option<f64> where { unit: "kg*m^2" },
        /// Element xz.
        pub ixz: Option<f64> where { unit: "kg*m^2" },
        /// Element yy.
        pub iyy: Option<f64> where { unit: "kg*m^2" },
        /// Element yz.
        pub iyz: Option<f64> where { unit: "kg*m^2" },
        /// Element zz.
        pub izz: Option<f64> where { unit: "kg*m^2" },
    }

    /// What a link looks like, or a part of it.
    pub struct Visual {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        pub origin: Option<Origin> where { frame: "link" },
        /// Its shape.
        pub geometry: Option<Geometry> where { frame: "shape" },
        /// Its material.
        pub material: Option<Material>,
    }

    /// What a link collides with, or a part of it.
    pub struct Collision {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        pub origin: Option<Origin> where { frame: "link" },
        /// Its shape.
        pub geometry: Option<Geometry> where { frame: "shape" },
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
        /// File name as the URDF has it (`package://…`, `file://…`, relative or absolute).
        pub filename: String,
        /// Factors along x, y, z; null means 1, 1, 1.
        pub scale: Option<[f64; 3]> where { unit: "1" },
    }

    /// A box about the origin.
    pub struct Cuboid {
        /// Full side lengths along x, y, z, metres.
        pub size: [f64; 3] where { unit: "m" },
    }

    /// A cylinder about the origin, along z.
    pub struct Cylinder {
        /// Radius, metres.
        pub radius: f64 where { unit: "m" },
        /// Full length, metres.
        pub length: f64 where { unit: "m" },
    }

    /// A capsule about the origin, along z: a cylinder with half a sphere on each end.
    pub struct Capsule {
        /// Radius, metres.
        pub radius: f64 where { unit: "m" },
        /// Length of the cylinder without the half spheres, metres.
        pub length: f64 where { unit: "m" },
    }

    /// A sphere about the origin.
    pub struct Sphere {
        /// Radius, metres.
        pub radius: f64 where { unit: "m" },
    }

    /// A material, or a reference to one by its name.
    pub struct Material {
        /// Name.
        pub name: Option<String>,
        /// Colour.
        pub color: Option<Color>,
        /// Texture.
        pub texture: Option<Texture>,
    }

    /// A colour.
    pub struct Color {
        /// Red, green, blue, opacity, each from 0 to 1.
        pub rgba: [f64; 4] where { unit: "1" },
    }

    /// A texture.
    pub struct Texture {
        /// File name as the URDF has it.
        pub filename: String,
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
        /// Moves freely. Six DOFs: x, y, z (m), then a rotation vector (rad).
        Floating,
        /// Slides in the plane normal to its axis and turns about it. Three DOFs: x, y (m), angle (rad).
        Planar,
        /// Turns freely. Three DOFs: a rotation vector (rad). Not in URDF's own list; accepted by many readers.
        Spherical,
    }

    /// A joint: how one link moves on another.
    pub struct Joint {
        /// Name, unique among the joints.
        pub name: String,
        /// How it moves.
        pub joint_type: JointType,
        /// Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.
        pub origin: Option<Origin> where { frame: "parent_link" },
        /// The link that carries the joint.
        pub parent: LinkName,
        /// The link that the joint moves.
        pub child: LinkName,
        /// Axis in the joint's frame, as written: not normalised. Null means (1, 0, 0).
        pub axis: Option<Axis> where { frame: "joint" },
        /// Limits.
        pub limit: Option<Limit>,
        /// Damping and friction.
        pub dynamics: Option<Dynamics>,
        /// The joint that this one follows.
        pub mimic: Option<Mimic>,
        /// Soft limits.
        pub safety_controller: Option<SafetyController>,
        /// Reference positions.
        pub calibration: Option<Calibration>,
        /// Other elements directly under `<joint>`, each as its own XML text.
        pub unknown_elements: Vec<String>,
    }

    /// A link, by name.
    pub struct LinkName {
        /// Name of the link.
        pub link: String,
    }

    /// The axis of a joint.
    pub struct Axis {
        /// Direction in the joint's frame, of any length but zero.
        pub xyz: Option<[f64; 3]> where { unit: "1" },
    }

    /// Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones.
    #[derive(Copy)]
    pub struct Limit {
        /// Smallest position.
        pub lower: Option<f64> where { unit: "rad or m" },
        /// Largest position.
        pub upper: Option<f64> where { unit: "rad or m" },
        /// Largest effort.
        pub effort: Option<f64> where { unit: "N*m or N" },
        /// Largest speed.
        pub velocity: Option<f64> where { unit: "rad/s or m/s" },
        /// Largest acceleration, rad/s² or m/s². This and the next two: from URDF version 1.2 on.
        pub acceleration: Option<f64> where { unit: "rad/s^2 or m/s^2" },
        /// Largest deceleration, rad/s² or m/s²; where it is absent, that of `acceleration`.
        pub deceleration: Option<f64> where { unit: "rad/s^2 or m/s^2" },
        /// Largest rate of change of acceleration, rad/s³ or m/s³.
        pub jerk: Option<f64> where { unit: "rad/s^3 or m/s^3" },
    }

    /// Dynamics of a joint.
    pub struct Dynamics {
        /// Damping: N m s/rad, or N s/m.
        pub damping: Option<f64> where { unit: "N*m*s/rad or N*s/m" },
        /// Static friction: N m, or N.
        pub friction: Option<f64> where { unit: "N*m or N" },
    }

    /// Follows another joint: `position = multiplier * position of joint + offset`.
    pub struct Mimic {
        /// Name of the joint that is followed.
        pub joint: String,
        /// Factor; null means 1.
        pub multiplier: Option<f64> where { unit: "1 or rad/m or m/rad" },
        /// Offset, rad or m; null means 0.
        pub offset: Option<f64> where { unit: "rad or m" },
    }

    /// Soft limits of a joint.
    pub struct SafetyController {
        /// Where the controller begins to limit the position, below.
        pub soft_lower_limit: Option<f64> where { unit: "rad or m" },
        /// Where the controller begins to limit the position, above.
        pub soft_upper_limit: Option<f64> where { unit: "rad or m" },
        /// Relation between position and velocity limits.
        pub k_position: Option<f64> where { unit: "1/s" },
        /// Relation between effort and velocity limits.
        pub k_velocity: Option<f64> where { unit: "N*m*s/rad or N*s/m" },
    }

    /// Reference positions of a joint.
    pub struct Calibration {
        /// Position at which a rising edge is seen.
        pub rising: Option<f64> where { unit: "rad or m" },
        /// Position at which a falling edge is seen.
        pub falling: Option<f64> where { unit: "rad or m" },
    }
}

impl Link {
    /// A link with only a name.
    pub fn new(name: impl Into<String>) -> Self {
        let (visual, collision, unknown_elements) = Default::default();
        Link { name: name.into(), inertial: None, visual, collision, unknown_elements }
    }
}

impl Joint {
    /// A joint with only what every joint has.
    pub fn new(
        name: impl Into<String>,
        joint_type: JointType,
        parent: impl Into<String>,
        child: impl Into<String>,
    ) -> Self {
        Joint {
            name: name.into(),
            joint_type,
            origin: None,
            parent: LinkName { link: parent.into() },
            child: LinkName { link: child.into() },
            axis: None,
            limit: None,
            dynamics: None,
            mimic: None,
            safety_controller: None,
            calibration: None,
            unknown_elements: Vec::new(),
        }
    }
}
