//! Errors of queries on a robot.

use thiserror::Error;

use urdd_directory::cancellation::Cancelled;
use urdd_directory::root::ReadError;
use urdd_format::registry::ModuleKind;
use urdd_format::shape_kind::UnknownShapeKind;
use urdd_kinematics::loops::Gap;
use urdd_kinematics::{ConfigurationError, KinematicsError};

/// Errors of queries on a robot.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The folder or archive cannot be opened.
    #[error("{path}: {error}")]
    Open {
        /// Its path.
        path: String,
        /// Why.
        error: ReadError,
    },
    /// The folder has no URDD.
    #[error(
        "{path}: there is no URDD in this folder: neither urdd.json nor the folder of a module"
    )]
    NoUrdd {
        /// Its path.
        path: String,
    },
    /// The URDD in this folder changed after it was opened, and the answer needs what was not read before.
    #[error("{}: it changed on disk since it was opened: open it again", .0.escape_debug())]
    Changed(String),
    /// The robot's files cannot be listed.
    #[error("the files of the URDD cannot be listed: {0}")]
    List(ReadError),
    /// A required module is missing.
    #[error("{} is missing: generate it with `urdd generate ROBOT.urdf -o DIR --modules {}`", .0.name(), .0.short_name())]
    Missing(ModuleKind),
    /// A required module is unusable.
    #[error("{}: {reason}: run `urdd validate` for details", .module.name())]
    Unusable {
        /// Which module.
        module: ModuleKind,
        /// The first problem, with its location.
        reason: String,
    },
    /// A legacy URDD does not define how its joints move.
    #[error("the modules do not define how the joints move: run `urdd validate` for details")]
    MotionOpen,
    /// `urdd.json` is missing or unusable.
    #[error("urdd.json: {0}")]
    Metadata(String),
    /// The modules do not define valid kinematics.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A configuration without link poses.
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
    /// The number of values in a batch is not a multiple of the number of DOFs.
    #[error("{found} values do not divide into configurations of {dofs} values")]
    Batch {
        /// Number of values.
        found: usize,
        /// Number of DOFs.
        dofs: usize,
    },
    /// Not enough memory for the results.
    #[error(
        "not enough memory for {count} configurations with {width} results each: ask for fewer at once"
    )]
    Memory {
        /// Number of configurations.
        count: usize,
        /// Values for each of them.
        width: usize,
    },
    /// The output slice has the wrong length.
    #[error("expected room for {count} times {width} values, found {found}")]
    Room {
        /// Length of the output slice.
        found: usize,
        /// Number of configurations.
        count: usize,
        /// Values for each of them.
        width: usize,
    },
    /// Unknown name.
    #[error("there is no {what} `{}`{}", .name.escape_debug(), nearest_text(.nearest.as_deref()))]
    Unknown {
        /// Kind of name: `link`, `joint`, `DOF`, `configuration` or `kind of shapes`.
        what: &'static str,
        /// The name.
        name: String,
        /// The most similar known name.
        nearest: Option<String>,
    },
    /// A position beyond the bounds of a limited DOF.
    #[error("the DOF `{}` cannot be at {position}: its bounds are {lower} and {upper}", .dof.escape_debug())]
    OutOfBounds {
        /// The DOF.
        dof: String,
        /// The position, rad or m.
        position: f64,
        /// The lower bound.
        lower: f64,
        /// The upper bound.
        upper: f64,
    },
    /// Index out of range.
    #[error("{what} {index} is out of range: there are {count}")]
    OutOfRange {
        /// What is indexed.
        what: &'static str,
        /// The index.
        index: usize,
        /// Number of items.
        count: usize,
    },
    /// A motion that is too long to be checked.
    #[error("the motion needs more than {most} steps: divide it, or give a coarser resolution")]
    Steps {
        /// The most steps.
        most: u64,
    },
    /// An end of a motion in which a loop is open.
    #[error(
        "the {end} of the motion is not closed: the loop `{}` is {} m and {} rad apart: call `close` first, or ask for open loops",
        .name.escape_debug(), .gap.position, .gap.rotation
    )]
    NotClosed {
        /// `start` or `end`.
        end: &'static str,
        /// The loop.
        name: String,
        /// How far it is apart.
        gap: Gap,
    },
    /// An end of a motion in which a coupling does not hold.
    #[error(
        "the {end} of the motion is not closed: the sum of the coupling `{}` is {sum}, not 0: call `close` first, or ask for open loops",
        .name.escape_debug()
    )]
    NotCoupled {
        /// `start` or `end`.
        end: &'static str,
        /// The coupling.
        name: String,
        /// Its sum.
        sum: f64,
    },
    /// A margin or a resolution that makes no sense.
    #[error("{0}")]
    Setting(&'static str),
    /// An invalid target or invalid bounds for inverse kinematics.
    #[error("inverse kinematics: {0}")]
    Target(&'static str),
    /// An invalid obstacle.
    #[error("obstacle `{}`: {reason}", .name.escape_debug())]
    Obstacle {
        /// Its name.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// An invalid sphere of a link.
    #[error("sphere {sphere} of link {link}: {reason}")]
    Sphere {
        /// The link.
        link: usize,
        /// The index of the sphere among those of the link.
        sphere: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A value of a configuration that is too large for spheres.
    #[error(
        "value {dof_idx} of the configuration is {value}: spheres are checked up to 1e9 rad and 1e9 m"
    )]
    Far {
        /// Index of the DOF.
        dof_idx: usize,
        /// Its value, rad or m.
        value: f64,
    },
    /// The computation was cancelled: [`Queries::in_collision_batch_into`](super::Queries::in_collision_batch_into).
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// An unusable mesh file.
    #[error("{}: {reason}", .path.escape_debug())]
    Mesh {
        /// Its path, as written in the module.
        path: String,
        /// What is wrong with it.
        reason: String,
    },
}

impl From<UnknownShapeKind> for RobotError {
    fn from(UnknownShapeKind(name): UnknownShapeKind) -> Self {
        RobotError::Unknown { what: "kind of shapes", name, nearest: None }
    }
}

fn nearest_text(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean `{}`?", name.escape_debug()))
}
