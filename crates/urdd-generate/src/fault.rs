//! What makes a file no robot: it is refused, since any reading of it would be a guess.

use thiserror::Error;

/// Why a text is no robot.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// Not well-formed XML.
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    /// It declares entities.
    #[error(
        "the file declares XML entities of its own (`<!ENTITY`), which are not read; `xmllint --noent FILE` writes the file without them"
    )]
    Entities,
    /// The outermost element is another.
    #[error("the outermost element is `<{0}>`, and that of a URDF is `<robot>`{hint}", hint = sdf_hint(.0))]
    NotRobot(String),
    /// Macros that are not expanded make up the robot.
    #[error(
        "the file holds xacro macros only, and no link; expand it first: `xacro FILE > robot.urdf`"
    )]
    OnlyMacros,
    /// A thing without its name.
    #[error("`<{element}>` needs the attribute `{attribute}`")]
    MissingAttribute {
        /// The element.
        element: &'static str,
        /// The attribute.
        attribute: &'static str,
    },
    /// A joint without a parent or child.
    #[error("joint `{joint}` has no `<{element}>`")]
    MissingElement {
        /// The joint.
        joint: String,
        /// The element that is not there.
        element: &'static str,
    },
    /// A joint type that URDF does not define.
    #[error(
        "joint `{joint}` is of type `{found}`; the types of URDF are revolute, continuous, prismatic, fixed, floating, planar, spherical"
    )]
    UnknownJointType {
        /// The joint.
        joint: String,
        /// The type.
        found: String,
    },
    /// A rotation that is given in two ways.
    #[error("`rpy` and `quat_xyzw` both say the rotation of an `<origin>`; keep one of them")]
    TwoRotations,
    /// Two links of one name.
    #[error("there are two links named `{name}`; the other one is in line {first}")]
    TwoLinks {
        /// The name.
        name: String,
        /// Line of the first.
        first: u32,
    },
    /// Two joints of one name.
    #[error("there are two joints named `{name}`; the other one is in line {first}")]
    TwoJoints {
        /// The name.
        name: String,
        /// Line of the first.
        first: u32,
    },
    /// A joint between links that are not there.
    #[error("joint `{joint}` has the {end} link `{link}`, and there is no such link{hint}")]
    UnknownLink {
        /// The joint.
        joint: String,
        /// `parent` or `child`.
        end: &'static str,
        /// The link that is not there.
        link: String,
        /// A name that may be meant, in words.
        hint: String,
    },
    /// A link that two joints move.
    #[error(
        "link `{link}` is the child of joint `{joint}`, and of joint `{first}` already: a URDF is a tree"
    )]
    TwoParents {
        /// The link.
        link: String,
        /// The joint.
        joint: String,
        /// The joint that comes first.
        first: String,
    },
    /// No link.
    #[error("there is no `<link>` in `<robot>`")]
    NoLinks,
    /// Links that no joint holds together.
    #[error(
        "{count} links are no joint's child, and a URDF has one root: {names}. Join them with `fixed` joints, or take the loose ones out"
    )]
    ManyRoots {
        /// How many.
        count: usize,
        /// The first of them.
        names: String,
    },
    /// Joints in a ring.
    #[error("the joints go in a circle: {0}. A URDF is a tree")]
    Cycle(String),
    /// Mimics in a ring.
    #[error("the mimic of joint `{0}` leads back to that joint")]
    MimicCircle(String),
    /// Mimics whose product is no number.
    #[error(
        "the multipliers or offsets along the mimics of joint `{0}` are beyond what a 64-bit number holds"
    )]
    MimicOverflow(String),
    /// An axis without direction.
    #[error(
        "joint `{joint}` is {joint_type} about the axis `{axis}`, which has no direction; give it one, or make the joint fixed"
    )]
    ZeroAxis {
        /// The joint.
        joint: String,
        /// Its type.
        joint_type: String,
        /// The axis as written.
        axis: String,
    },
    /// Poses beyond 64-bit numbers.
    #[error("the numbers are so large that no 64-bit number holds where the links are ({0})")]
    NoPoses(String),
    /// More links than URDDs are made for.
    #[error(
        "the robot has {found} links, and URDDs are made of up to {limit}: lists over all pairs of links grow with the square"
    )]
    TooManyLinks {
        /// How many it has.
        found: usize,
        /// How many it may have.
        limit: usize,
    },
    /// More elements than URDDs are made for.
    #[error(
        "the robot has {found} elements (shapes, materials, and elements that URDF does not know), and URDDs are made of up to {limit}"
    )]
    TooManyElements {
        /// How many it has.
        found: usize,
        /// How many it may have.
        limit: usize,
    },
    /// A link with more triangles than URDDs are made for.
    #[error(
        "the shapes of link `{link}` have {found} triangles, and URDDs are made of up to {limit} a link; make its meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTriangles {
        /// The link.
        link: String,
        /// How many it has.
        found: usize,
        /// How many it may have.
        limit: usize,
    },
    /// More triangles of all links than URDDs are made for.
    #[error(
        "the shapes of all links have more than {limit} triangles, which is the most that URDDs are made of; make the meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTrianglesInAll {
        /// How many they may have.
        limit: usize,
    },
    /// A shape that 32-bit numbers do not hold.
    #[error(
        "link `{link}`: its shape is too thin, or too far from the link's frame, for the 32-bit numbers of mesh files; check its units and origin, or leave meshes out: `--modules core`"
    )]
    Unresolved {
        /// The link.
        link: String,
    },
    /// More than the format counts.
    #[error("there are more than {0} elements")]
    TooMany(u32),
}

fn sdf_hint(element: &str) -> &'static str {
    match element {
        "sdf" => ": this is SDF; convert it to URDF first",
        "mujoco" => ": this is a MuJoCo model; convert it to URDF first",
        "xacro:macro" => ": this is a xacro macro file, to be included by others",
        _ => "",
    }
}

/// A fault, and where it is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlacedFault {
    /// Line in the text, from 1.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub fault: Fault,
}
