//! Errors of `NAME.export.toml`.

use thiserror::Error;

use urdd_directory::position::Position;
use urdd_robot::RobotError;

use crate::error::ExportError;

/// Errors of a file with what exports need.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The content is wrong.
    #[error("{}{}: {fault}", .file.escape_debug(), .at.map_or(String::new(), |at| format!(":{at}")))]
    Content {
        /// The file.
        file: String,
        /// The place.
        at: Option<Position>,
        /// What is wrong.
        fault: SetupFault,
    },
    /// The file cannot be read.
    #[error("{}: {reason}", .file.escape_debug())]
    Unreadable {
        /// The file.
        file: String,
        /// Why.
        reason: String,
    },
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] ExportError),
}

impl From<RobotError> for SetupError {
    fn from(error: RobotError) -> Self {
        SetupError::Robot(error.into())
    }
}

/// What is wrong in a file with what exports need.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SetupFault {
    /// Not TOML, a wrong type, or an unknown key.
    #[error("{0}")]
    Toml(String),
    /// The file of another robot.
    #[error("this file is for robot `{}`, not for `{}`; `urdd export init` writes one", .found.escape_debug(), .expected.escape_debug())]
    OtherRobot {
        /// The robot in the file.
        found: String,
        /// The robot that is exported.
        expected: String,
    },
    /// A name that the robot, its URDD or the file does not have.
    #[error("there is no {what} `{}`{}", .name.escape_debug(), .nearest.as_ref().map_or(String::new(), |near| format!("; did you mean `{}`?", near.escape_debug())))]
    Unknown {
        /// What was looked for, such as `link`.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest name that there is.
        nearest: Option<String>,
    },
    /// A name that is given twice.
    #[error("another {what} is called `{}`: give it another name", .name.escape_debug())]
    Twice {
        /// What has the name.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A group without members, or with more than one kind of them.
    #[error("the group `{}` needs `base` and `tip`, or `joints`, or `groups`, and only one of these", .0.escape_debug())]
    Members(String),
    /// A chain that does not go from an ancestor to a descendant, or moves nothing.
    #[error("the link `{}` is not an ancestor of `{}`, or no joint between them moves", .base.escape_debug(), .tip.escape_debug())]
    Chain {
        /// The first link.
        base: String,
        /// The last link.
        tip: String,
    },
    /// A joint that nothing can drive.
    #[error("the joint `{}` is fixed, or follows another joint: nothing drives it", .0.escape_debug())]
    Still(String),
    /// Groups that contain themselves.
    #[error("the group `{}` contains itself", .0.escape_debug())]
    Cycle(String),
    /// A number out of its range.
    #[error("`{key}` is {needs}")]
    Number {
        /// The key.
        key: &'static str,
        /// What it has to be.
        needs: &'static str,
    },
}
