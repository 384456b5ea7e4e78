//! Faults for which a file is refused: any interpretation of it would be a guess.

use thiserror::Error;

/// Why a text is not a valid robot description.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Fault {
    /// Not well-formed XML.
    #[error("not well-formed XML: {0}")]
    NotXml(String),
    /// The file declares XML entities.
    #[error(
        "the file declares XML entities of its own (`<!ENTITY`), which are not supported; `xmllint --noent FILE` writes the file without them"
    )]
    Entities,
    /// The root element is not `<robot>`.
    #[error("the outermost element is `<{0}>`, but that of a URDF is `<robot>`{hint}", hint = sdf_hint(.0))]
    NotRobot(String),
    /// The robot consists of xacro macros that are not expanded.
    #[error(
        "the file contains only xacro macros, and no link; expand it first: `xacro FILE > robot.urdf`"
    )]
    OnlyMacros,
    /// A required attribute is missing.
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
        /// The missing element.
        element: &'static str,
    },
    /// A joint type that URDF does not define.
    #[error(
        "joint `{joint}` has the unknown type `{found}`; the types of URDF are revolute, continuous, prismatic, fixed, floating, planar, spherical"
    )]
    UnknownJointType {
        /// The joint.
        joint: String,
        /// The type.
        found: String,
    },
    /// A rotation given both as `rpy` and as `quat_xyzw`.
    #[error("`rpy` and `quat_xyzw` both give the rotation of an `<origin>`; keep one of them")]
    TwoRotations,
    /// Two links with the same name.
    #[error("two links are named `{name}`; the other one is on line {first}")]
    TwoLinks {
        /// The name.
        name: String,
        /// Line of the first.
        first: u32,
    },
    /// Two joints with the same name.
    #[error("two joints are named `{name}`; the other one is on line {first}")]
    TwoJoints {
        /// The name.
        name: String,
        /// Line of the first.
        first: u32,
    },
    /// A joint whose parent or child link does not exist.
    #[error("joint `{joint}` has the {end} link `{link}`, which does not exist{hint}")]
    UnknownLink {
        /// The joint.
        joint: String,
        /// `parent` or `child`.
        end: &'static str,
        /// The missing link.
        link: String,
        /// A suggestion of a similar name.
        hint: String,
    },
    /// A link that is the child of two joints.
    #[error(
        "link `{link}` is the child of joint `{joint}`, and already of joint `{first}`: a URDF must be a tree"
    )]
    TwoParents {
        /// The link.
        link: String,
        /// The joint.
        joint: String,
        /// The joint that comes first.
        first: String,
    },
    /// The robot has no links.
    #[error("`<robot>` contains no `<link>`")]
    NoLinks,
    /// Several root links.
    #[error(
        "{count} links are not the child of any joint, but a URDF has one root: {names}. Connect them with `fixed` joints, or remove the loose ones"
    )]
    ManyRoots {
        /// The number of root links.
        count: usize,
        /// The names of the first ones.
        names: String,
    },
    /// The joints form a cycle.
    #[error("the joints form a cycle: {0}. A URDF must be a tree")]
    Cycle(String),
    /// Mimic joints form a cycle.
    #[error("the mimic of joint `{0}` leads back to that joint")]
    MimicCircle(String),
    /// The product of mimic multipliers, or an offset, overflows binary64.
    #[error(
        "the multipliers or offsets along the mimics of joint `{0}` are beyond the range of 64-bit numbers"
    )]
    MimicOverflow(String),
    /// A zero axis.
    #[error(
        "joint `{joint}` is {joint_type}, but its axis `{axis}` has no direction; give it one, or make the joint fixed"
    )]
    ZeroAxis {
        /// The joint.
        joint: String,
        /// Its type.
        joint_type: String,
        /// The axis as written.
        axis: String,
    },
    /// Link poses overflow binary64.
    #[error("the numbers in the URDF are too large ({0})")]
    NoPoses(String),
    /// The pose of a link overflows binary64.
    #[error(
        "the URDF places the child of joint `{joint}` beyond the range of 64-bit numbers, in the configuration {configuration}; correct the origins, limits or mimics on the way to it"
    )]
    PosesTooLarge {
        /// The joint that moves the link.
        joint: String,
        /// The configuration.
        configuration: String,
    },
    /// The robot has more links than the generator accepts.
    #[error(
        "the robot has {found} links, but a URDD has at most {limit}: lists over all pairs of links grow with the square of their number"
    )]
    TooManyLinks {
        /// The number found.
        found: usize,
        /// The maximum number.
        limit: usize,
    },
    /// The robot has more elements than the generator accepts.
    #[error(
        "the robot has {found} elements (shapes, materials, and elements that URDF does not know), but a URDD has at most {limit}"
    )]
    TooManyElements {
        /// The number found.
        found: usize,
        /// The maximum number.
        limit: usize,
    },
    /// A link has more triangles than the generator accepts.
    #[error(
        "the shapes of link `{link}` have {found} triangles, but a link of a URDD has at most {limit}; make its meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTriangles {
        /// The link.
        link: String,
        /// The number found.
        found: usize,
        /// The maximum number.
        limit: usize,
    },
    /// All links together have more triangles than the generator accepts.
    #[error(
        "the shapes of all links have more than {limit} triangles, the limit of a URDD; make the meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTrianglesInAll {
        /// The maximum number.
        limit: usize,
    },
    /// A shape that binary32 cannot resolve.
    #[error(
        "link `{link}`: its shape is too thin, or too far from the link's frame, for the 32-bit numbers of mesh files; check its units and origin, or leave meshes out: `--modules core`"
    )]
    Unresolved {
        /// The link.
        link: String,
    },
    /// More elements than an index of the format can count.
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

/// A fault and its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlacedFault {
    /// Line in the text, from 1.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub fault: Fault,
}
