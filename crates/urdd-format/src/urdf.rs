//! `urdf_module`: the complete source URDF as JSON.

use super::annotations::lengths;
use super::object::{module, object, string_enum};
use super::tagged::tagged;

module! {
    /// The source URDF as data. What the URDF leaves out is null (or an empty list), never a default.
    /// Lengths are metres, angles radians, masses kilograms; rotations are the URDF's own fixed-axis
    /// roll, pitch, yaw. Numbers that are not finite in the URDF are written as null.
    pub struct UrdfModule {
        /// Name of the robot (`<robot name>`).
        pub name: String,
        /// The URDF format version that the file states (`<robot version>`).
        pub version: Option<String>,
        /// Links in the order of the file. The place in this list is the link index.
        #[schemars(transform = lengths("links"))]
        pub links: Vec<Link>,
        /// Joints in the order of the file. The place in this list is the joint index.
        #[schemars(transform = lengths("joints"))]
        pub joints: Vec<Joint>,
        /// Materials declared at the top of the file, in its order.
        pub materials: Vec<Material>,
        /// Other elements directly under `<robot>` (transmission, gazebo, ros2_control, …), each as
        /// its own XML text, in the order of the file.
        pub unknown_elements: Vec<String>,
    }
}

object! {
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
}

object! {
    /// Mass properties of a link.
    pub struct Inertial {
        /// Centre of mass, and the axes of `inertia`, in the link's frame.
        #[schemars(extend("x-frame" = "link"))]
        pub origin: Option<Origin>,
        /// Mass.
        pub mass: Option<Mass>,
        /// Inertia tensor about the centre of mass, in the axes of `origin`.
        #[schemars(extend("x-frame" = "inertial"))]
        pub inertia: Option<Inertia>,
    }
}

object! {
    /// A pose as the URDF writes it.
    pub struct Origin {
        /// Position, metres: x, y, z.
        #[schemars(extend("x-unit" = "m"))]
        pub xyz: Option<[f64; 3]>,
        /// Fixed-axis roll, pitch, yaw, radians: turn about x, then y, then z of the outer frame.
        #[schemars(extend("x-unit" = "rad"))]
        pub rpy: Option<[f64; 3]>,
        /// Rotation as a quaternion x, y, z, w of any length but zero, instead of `rpy`. It counts
        /// from URDF version 1.1 on; before, it has no meaning.
        #[schemars(extend("x-unit" = "1"))]
        pub quat_xyzw: Option<[f64; 4]>,
    }
}

object! {
    /// Mass of a link.
    pub struct Mass {
        /// Kilograms.
        #[schemars(extend("x-unit" = "kg"))]
        pub value: f64,
    }
}

object! {
    /// The six independent elements of a symmetric inertia tensor, kg m².
    pub struct Inertia {
        /// Element xx.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub ixx: Option<f64>,
        /// Element xy.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub ixy: Option<f64>,
        /// Element xz.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub ixz: Option<f64>,
        /// Element yy.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub iyy: Option<f64>,
        /// Element yz.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub iyz: Option<f64>,
        /// Element zz.
        #[schemars(extend("x-unit" = "kg*m^2"))]
        pub izz: Option<f64>,
    }
}

object! {
    /// What a link looks like, or a part of it.
    pub struct Visual {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        #[schemars(extend("x-frame" = "link"))]
        pub origin: Option<Origin>,
        /// Its shape.
        #[schemars(extend("x-frame" = "shape"))]
        pub geometry: Option<Geometry>,
        /// Its material.
        pub material: Option<Material>,
    }
}

object! {
    /// What a link collides with, or a part of it.
    pub struct Collision {
        /// Name of the element.
        pub name: Option<String>,
        /// Pose of the geometry in the link's frame.
        #[schemars(extend("x-frame" = "link"))]
        pub origin: Option<Origin>,
        /// Its shape.
        #[schemars(extend("x-frame" = "shape"))]
        pub geometry: Option<Geometry>,
    }
}

tagged! {
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
}

object! {
    /// A mesh file.
    pub struct Mesh {
        /// File name as the URDF has it (`package://…`, `file://…`, relative or absolute).
        pub filename: String,
        /// Factors along x, y, z; null means 1, 1, 1.
        #[schemars(extend("x-unit" = "1"))]
        pub scale: Option<[f64; 3]>,
    }
}

object! {
    /// A box about the origin.
    pub struct Cuboid {
        /// Full side lengths along x, y, z, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub size: [f64; 3],
    }
}

object! {
    /// A cylinder about the origin, along z.
    pub struct Cylinder {
        /// Radius, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub radius: f64,
        /// Full length, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub length: f64,
    }
}

object! {
    /// A capsule about the origin, along z: a cylinder with half a sphere on each end.
    pub struct Capsule {
        /// Radius, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub radius: f64,
        /// Length of the cylinder without the half spheres, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub length: f64,
    }
}

object! {
    /// A sphere about the origin.
    pub struct Sphere {
        /// Radius, metres.
        #[schemars(extend("x-unit" = "m"))]
        pub radius: f64,
    }
}

object! {
    /// A material, or a reference to one by its name.
    pub struct Material {
        /// Name.
        pub name: Option<String>,
        /// Colour.
        pub color: Option<Color>,
        /// Texture.
        pub texture: Option<Texture>,
    }
}

object! {
    /// A colour.
    pub struct Color {
        /// Red, green, blue, opacity, each from 0 to 1.
        #[schemars(extend("x-unit" = "1"))]
        pub rgba: [f64; 4],
    }
}

object! {
    /// A texture.
    pub struct Texture {
        /// File name as the URDF has it.
        pub filename: String,
    }
}

string_enum! {
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
}

object! {
    /// A joint: how one link moves on another.
    pub struct Joint {
        /// Name, unique among the joints.
        pub name: String,
        /// How it moves.
        pub joint_type: JointType,
        /// Pose of the joint's frame (which is the child link's frame at zero) in the parent link's frame.
        #[schemars(extend("x-frame" = "parent_link"))]
        pub origin: Option<Origin>,
        /// The link that carries the joint.
        pub parent: LinkName,
        /// The link that the joint moves.
        pub child: LinkName,
        /// Axis in the joint's frame, as written: not normalised. Null means (1, 0, 0).
        #[schemars(extend("x-frame" = "joint"))]
        pub axis: Option<Axis>,
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
}

object! {
    /// A link, by name.
    pub struct LinkName {
        /// Name of the link.
        pub link: String,
    }
}

object! {
    /// The axis of a joint.
    pub struct Axis {
        /// Direction in the joint's frame, of any length but zero.
        #[schemars(extend("x-unit" = "1"))]
        pub xyz: Option<[f64; 3]>,
    }
}

object! {
    /// Limits of a joint: rad, rad/s, N m for turning joints; m, m/s, N for sliding ones.
    pub struct Limit {
        /// Smallest position.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub lower: Option<f64>,
        /// Largest position.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub upper: Option<f64>,
        /// Largest effort.
        #[schemars(extend("x-unit" = "N*m or N"))]
        pub effort: Option<f64>,
        /// Largest speed.
        #[schemars(extend("x-unit" = "rad/s or m/s"))]
        pub velocity: Option<f64>,
        /// Largest acceleration, rad/s² or m/s². This and the next two: from URDF version 1.2 on.
        #[schemars(extend("x-unit" = "rad/s^2 or m/s^2"))]
        pub acceleration: Option<f64>,
        /// Largest deceleration, rad/s² or m/s²; where it is absent, that of `acceleration`.
        #[schemars(extend("x-unit" = "rad/s^2 or m/s^2"))]
        pub deceleration: Option<f64>,
        /// Largest rate of change of acceleration, rad/s³ or m/s³.
        #[schemars(extend("x-unit" = "rad/s^3 or m/s^3"))]
        pub jerk: Option<f64>,
    }
}

object! {
    /// Dynamics of a joint.
    pub struct Dynamics {
        /// Damping: N m s/rad, or N s/m.
        #[schemars(extend("x-unit" = "N*m*s/rad or N*s/m"))]
        pub damping: Option<f64>,
        /// Static friction: N m, or N.
        #[schemars(extend("x-unit" = "N*m or N"))]
        pub friction: Option<f64>,
    }
}

object! {
    /// Follows another joint: `position = multiplier * position of joint + offset`.
    pub struct Mimic {
        /// Name of the joint that is followed.
        pub joint: String,
        /// Factor; null means 1.
        #[schemars(extend("x-unit" = "1 or rad/m or m/rad"))]
        pub multiplier: Option<f64>,
        /// Offset, rad or m; null means 0.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub offset: Option<f64>,
    }
}

object! {
    /// Soft limits of a joint.
    pub struct SafetyController {
        /// Where the controller begins to limit the position, below.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub soft_lower_limit: Option<f64>,
        /// Where the controller begins to limit the position, above.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub soft_upper_limit: Option<f64>,
        /// Relation between position and velocity limits.
        #[schemars(extend("x-unit" = "1/s"))]
        pub k_position: Option<f64>,
        /// Relation between effort and velocity limits.
        #[schemars(extend("x-unit" = "N*m*s/rad or N*s/m"))]
        pub k_velocity: Option<f64>,
    }
}

object! {
    /// Reference positions of a joint.
    pub struct Calibration {
        /// Position at which a rising edge is seen.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub rising: Option<f64>,
        /// Position at which a falling edge is seen.
        #[schemars(extend("x-unit" = "rad or m"))]
        pub falling: Option<f64>,
    }
}
