//! Why a robot cannot be asked something.

use thiserror::Error;

use urdd_directory::cancellation::Cancelled;
use urdd_directory::root::ReadError;
use urdd_format::registry::ModuleKind;
use urdd_kinematics::{ConfigurationError, KinematicsError};

/// Why a robot cannot be asked something.
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
    /// The robot's files cannot be listed any more.
    #[error("the files of the URDD cannot be listed: {0}")]
    List(ReadError),
    /// A module that is needed is not there.
    #[error("{} is missing: make it with `urdd generate ROBOT.urdf -o DIR --modules {}`", .0.name(), short(*.0))]
    Missing(ModuleKind),
    /// A module that is needed is of no use.
    #[error("{}: {reason}: `urdd validate` says more", .module.name())]
    Unusable {
        /// Which module.
        module: ModuleKind,
        /// The first fault, with its place.
        reason: String,
    },
    /// A legacy URDD leaves open how joints move.
    #[error("the modules do not say how the joints move: `urdd validate` says more")]
    MotionOpen,
    /// `urdd.json` is missing or of no use.
    #[error("urdd.json: {0}")]
    Metadata(String),
    /// Modules that kinematics cannot be computed from.
    #[error(transparent)]
    Kinematics(#[from] KinematicsError),
    /// A configuration that has no link poses.
    #[error(transparent)]
    Configuration(#[from] ConfigurationError),
    /// A batch of configurations that is not a whole number of them.
    #[error("{found} values are no whole number of configurations of {dofs} values")]
    Batch {
        /// Number of values.
        found: usize,
        /// Number of DOFs.
        dofs: usize,
    },
    /// More answers than there is memory for.
    #[error(
        "not enough memory for {count} configurations with {width} values each: ask for fewer at once"
    )]
    Memory {
        /// Number of configurations.
        count: usize,
        /// Values for each of them.
        width: usize,
    },
    /// Room for another number of answers.
    #[error("expected room for {count} times {width} values, found {found}")]
    Room {
        /// Number of values that there is room for.
        found: usize,
        /// Number of configurations.
        count: usize,
        /// Values for each of them.
        width: usize,
    },
    /// A name that is not there.
    #[error("there is no {what} `{}`{}", .name.escape_debug(), nearest_text(.nearest.as_deref()))]
    Unknown {
        /// What it should be the name of: `link`, `joint` or `DOF`.
        what: &'static str,
        /// The name.
        name: String,
        /// The name that is nearest to it.
        nearest: Option<String>,
    },
    /// An index that is not there.
    #[error("there is no {what} {index}: their number is {count}")]
    OutOfRange {
        /// What is indexed.
        what: &'static str,
        /// The index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A target of inverse kinematics that is none.
    #[error("inverse kinematics: {0}")]
    Target(&'static str),
    /// An obstacle that is none.
    #[error("obstacle `{}`: {reason}", .name.escape_debug())]
    Obstacle {
        /// Its name.
        name: String,
        /// What is wrong with it.
        reason: String,
    },
    /// It was asked to stop: [`Proximity::until`](super::Proximity::until).
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// A mesh file that cannot be used.
    #[error("{}: {reason}", .path.escape_debug())]
    Mesh {
        /// Its path, as the module has it.
        path: String,
        /// What is wrong with it.
        reason: String,
    },
}

fn nearest_text(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| {
        format!("; did you mean `{}`?", name.escape_debug())
    })
}

/// A module's name as `--modules` takes it.
fn short(kind: ModuleKind) -> &'static str {
    kind.name().strip_suffix("_module").unwrap_or(kind.name())
}
