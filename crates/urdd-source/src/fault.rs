//! Faults for which a file is refused: any interpretation of it would be a guess.

use thiserror::Error;
use urdd_format::short::Short;

use super::format::Format;
use super::note::SourcePlace;

/// Why a text is not a valid robot description.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Fault {
    #[error("{0}")]
    NotXml(String),
    #[error(
        "the file declares XML entities of its own (`<!ENTITY`), which are not supported; `xmllint --noent FILE` writes the file without them"
    )]
    Entities,
    #[error("the outermost element is `<{0}>`, but that of a URDF is `<robot>`{hint}", hint = sdf_hint(.0))]
    NotRobot(Short),
    #[error(
        "the file contains only xacro macros, and no link; expand it first: `xacro FILE > robot.urdf`"
    )]
    OnlyMacros,
    #[error("`<{element}>` needs the attribute `{attribute}`")]
    MissingAttribute { element: &'static str, attribute: &'static str },
    #[error("joint `{joint}` has no `<{element}>`")]
    MissingElement { joint: Short, element: &'static str },
    #[error(
        "joint `{joint}` has the unknown type `{found}`; the types of URDF are revolute, continuous, prismatic, fixed, floating, planar, spherical"
    )]
    UnknownJointType { joint: Short, found: Short },
    #[error("`rpy` and `quat_xyzw` both give the rotation of an `<origin>`; keep one of them")]
    TwoRotations,
    #[error("two links are named `{name}`{other}", other = other(*.first))]
    TwoLinks { name: Short, first: u32 },
    #[error("two joints are named `{name}`{other}", other = other(*.first))]
    TwoJoints { name: Short, first: u32 },
    #[error("joint `{joint}` has the {end} link `{link}`, which does not exist{hint}")]
    UnknownLink {
        joint: Short,
        /// `parent` or `child`.
        end: &'static str,
        link: Short,
        /// A suggestion of a similar name.
        hint: String,
    },
    #[error(
        "link `{link}` is the child of joint `{joint}`, and already of joint `{first}`: a URDF must be a tree"
    )]
    TwoParents { link: Short, joint: Short, first: Short },
    #[error(
        "`<robot>` contains no `<link>`, but elements of an SRDF; give the URDF that the SRDF belongs to"
    )]
    IsSrdf,
    #[error("`<robot>` contains no `<link>`")]
    NoLinks,
    #[error(
        "{count} links are not the child of any joint, but a URDF has one root: {names}. Connect them with `fixed` joints, or remove the loose ones"
    )]
    ManyRoots {
        count: usize,
        /// The names of the first ones.
        names: String,
    },
    #[error("the joints form a cycle: {0}. A URDF must be a tree")]
    Cycle(String),
    #[error("the mimic of joint `{0}` leads back to that joint")]
    MimicCircle(Short),
    /// The product of mimic multipliers, or an offset, overflows binary64.
    #[error(
        "the multipliers or offsets along the mimics of joint `{0}` are beyond the range of 64-bit numbers"
    )]
    MimicOverflow(Short),
    #[error(
        "joint `{joint}` is {joint_type}, but its axis `{axis}` has no direction; give it one, or make the joint fixed"
    )]
    ZeroAxis { joint: Short, joint_type: String, axis: String },
    #[error("the numbers in the URDF are too large ({0})")]
    NoPoses(String),
    /// The pose of a link overflows binary64.
    #[error(
        "the URDF places the child of joint `{joint}` beyond the range of 64-bit numbers, in the configuration {configuration}; correct the origins, limits or mimics on the way to it"
    )]
    PosesTooLarge { joint: Short, configuration: String },
    #[error(
        "the robot has {found} links, but a URDD has at most {limit}: lists over all pairs of links grow with the square of their number"
    )]
    TooManyLinks { found: usize, limit: usize },
    #[error(
        "the robot has {found} elements (shapes, materials, and elements that URDF does not know), but a URDD has at most {limit}"
    )]
    TooManyElements { found: usize, limit: usize },
    #[error(
        "the shapes of link `{link}` have {found} triangles, but a link of a URDD has at most {limit}; make its meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTriangles { link: Short, found: usize, limit: usize },
    #[error(
        "the shapes of all links have more than {limit} triangles, the limit of a URDD; make the meshes coarser, or leave them out: `--modules core`"
    )]
    TooManyTrianglesInAll { limit: usize },
    /// A shape that binary32 cannot resolve.
    #[error(
        "link `{link}`: its shape is too thin, or too far from the link's frame, for the 32-bit numbers of mesh files; check its units and origin, or leave meshes out: `--modules core`"
    )]
    Unresolved { link: Short },
    #[error("there are more than {0} elements")]
    TooMany(u32),
}

/// Where the other one of a name is; 0 if that is in no file.
fn other(line: u32) -> String {
    if line == 0 { String::new() } else { format!("; the other one is on line {line}") }
}

fn sdf_hint(element: &str) -> &'static str {
    match (Format::of_root(element), element) {
        (Some(Format::Sdf), _) => ": this is SDF; `urdd import` makes a URDF of a file of it",
        (Some(Format::Mjcf), _) => {
            ": this is a MuJoCo model; `urdd import` makes a URDF of a file of it"
        }
        (Some(Format::Usd), _) => "",
        (None, "xacro:macro") => ": this is a xacro macro file, to be included by others",
        _ => "",
    }
}

/// A fault and its position.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlacedFault {
    /// The file, where that is not the one that the user named, but one that it includes.
    pub file: Option<String>,
    /// Line in the file, from 1; 0 for the file as a whole.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub fault: Fault,
}

impl PlacedFault {
    /// Where it is, in a file that the user named so or in one that it includes.
    pub fn place(&self, named: &str) -> SourcePlace {
        let file = self.file.as_deref().unwrap_or(named).to_owned();
        SourcePlace { file, line: self.line, column: self.column }
    }
}
