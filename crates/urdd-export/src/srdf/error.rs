//! What is wrong with an SRDF, for a robot.

use thiserror::Error;

use crate::ExportError;
use urdd_robot::RobotError;
use urdd_srdf::ReadError;

/// Errors of taking an SRDF into a URDD.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SrdfError {
    /// It cannot be read, or names what the robot does not have.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// What is read contradicts what a person wrote into the URDD.
    #[error("the URDD has {0}")]
    Edited(String),
    /// A query on the robot failed.
    #[error(transparent)]
    Robot(#[from] ExportError),
}

impl From<RobotError> for SrdfError {
    fn from(error: RobotError) -> Self {
        SrdfError::Robot(error.into())
    }
}
