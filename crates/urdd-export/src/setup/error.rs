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
    #[error("{}{}: {reason}", .file.escape_debug(), .at.map_or(String::new(), |at| format!(":{at}")))]
    Content {
        /// The file.
        file: String,
        /// The place.
        at: Option<Position>,
        /// What is wrong.
        reason: String,
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
