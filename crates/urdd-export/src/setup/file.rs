//! What is wrong with `NAME.export.toml`.

use thiserror::Error;
use toml::Spanned;

use crate::ExportError;
use urdd_directory::position::Position;
use urdd_robot::RobotError;

/// A value, or the byte offset of what is wrong, and what.
pub(super) type Placed<T> = Result<T, (usize, String)>;

/// What is wrong with a value, and where.
pub(super) fn wrong<T, V>(value: &Spanned<V>, reason: String) -> Placed<T> {
    Err((value.span().start, reason))
}

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
