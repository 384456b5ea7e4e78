//! Export errors.

use thiserror::Error;

use crate::{Format, Shapes};
use urdd_directory::account::AccountError;
use urdd_directory::range::OutOfRange;
use urdd_format::nearest::nearest;
use urdd_format::urdf::JointType;
use urdd_geometry::write::WriteError;
use urdd_robot::RobotError;

/// Errors of an export.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A query on the URDD failed.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// An option is out of its range.
    #[error(transparent)]
    Range(#[from] OutOfRange),
    /// Names are so long, and in so many pairs, that more would be written than an account allows.
    #[error(transparent)]
    Account(#[from] AccountError),
    /// The joints of the robot do not form a tree.
    #[error("the joints do not form a tree with one root: run `urdd validate` for details")]
    NoTree,
    /// A name that the format cannot represent.
    #[error("{} cannot hold the name `{}` of {} {what}: {reason}; {}", .format.name(), .name.escape_debug(), article(.what), remedy(.what))]
    Name {
        /// The format.
        format: Format,
        /// What has the name, such as `link`, `joint` or `robot`.
        what: &'static str,
        /// The name.
        name: String,
        /// Why it cannot be represented.
        reason: &'static str,
    },
    /// The mimic joints cannot be resolved.
    #[error(
        "a mimic names a joint that does not exist, or mimics form a cycle: run `urdd validate` for details"
    )]
    Mimics,
    /// The name of a package that ROS does not take.
    #[error("`{}` is no name of a package: it has small letters, digits and `_`, and a letter first; give one with --package, or another folder", .0.escape_debug())]
    Package(String),
    /// What the URDD does not say is that of another robot.
    #[error("the groups, frames and gains that were given are those of robot `{}`, not of `{}`", .found.escape_debug(), .expected.escape_debug())]
    OtherSetup {
        /// The robot that they belong to.
        found: String,
        /// The robot that is exported.
        expected: String,
    },
    /// The URDD has no shapes of the requested kind, and the format needs them.
    #[error("no link has {0}: choose other shapes, or another format")]
    NoShapes(Shapes),
    /// Spheres cannot be fitted to shapes of this kind.
    #[error("spheres are fitted to pieces or hulls, not to {0}: omit --shapes")]
    SpheresOf(Shapes),
    /// So many shapes that the URDD does not judge that judging their pairs would take too long.
    #[error(
        "there are {count} collision shapes or convex pieces of them, or more, and pairs of at most {most} are judged: export `urdf`, which has no pairs, or choose the shapes `pieces`, without `fit`"
    )]
    TooManyShapes {
        /// Number of shapes.
        count: usize,
        /// Maximum number.
        most: usize,
    },
    /// Distances between shapes that the URDD does not judge cannot be computed.
    #[error(
        "distances between these collision shapes cannot be computed: {0}; choose the shapes `pieces`, without `fit`"
    )]
    Unmeasurable(String),
    /// A binary file, and the format is a text.
    #[error("`{}` would be binary, and this is a text: write a `.usda`, and make the `{ending}` of it in Python, with usd-core: `{}`", .file.escape_debug(), binary(.ending))]
    Binary {
        /// The file.
        file: String,
        /// Its ending, `.usdc` or `.usdz`.
        ending: &'static str,
    },
    /// A link that cannot be the root.
    #[error("link `{}` cannot be the root: joint `{}` is between it and the root, and a {} joint cannot be turned round; choose a link that is not beyond it", .root.escape_debug(), .joint.escape_debug(), .kind.as_str().to_ascii_lowercase())]
    Root {
        /// The link.
        root: String,
        /// The joint.
        joint: String,
        /// Its type.
        kind: JointType,
    },
    /// Links whose mass together is more than a number holds.
    #[error("the mass properties of link `{}` and of what is fixed to it are together no finite numbers: run `urdd validate` for details, or leave out --merge-fixed", .link.escape_debug())]
    Infinite {
        /// The link that the others are joined with.
        link: String,
    },
    /// A mesh that cannot be written.
    #[error("the mesh of link `{}` cannot be written: {error}", .link.escape_debug())]
    Mesh {
        /// Its link.
        link: String,
        /// Why.
        error: WriteError,
    },
}

/// The error for a name that is not among the known ones.
pub(super) fn unknown<'n>(
    what: &'static str,
    name: &str,
    known: impl Iterator<Item = &'n str>,
) -> RobotError {
    RobotError::Unknown { what, name: name.to_owned(), nearest: nearest(known, name) }
}

/// What makes a binary file of a text.
fn binary(ending: &str) -> &'static str {
    if ending == ".usdz" {
        r#"UsdUtils.CreateNewUsdzPackage("x.usda", "x.usdz")"#
    } else {
        r#"Usd.Stage.Open("x.usda").Export("x.usdc")"#
    }
}

fn article(what: &str) -> &'static str {
    if what.starts_with('e') { "an" } else { "a" }
}

/// Where something gets its name.
fn remedy(what: &str) -> &'static str {
    match what {
        "group" | "end effector" => "give it another name in the file of `urdd export init`",
        "configuration" => "give it another name with `urdd configurations`",
        _ => "give it another name in the URDF, and generate the URDD again",
    }
}
