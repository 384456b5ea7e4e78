//! The speeds and efforts of DOFs.

use super::Robot;
use super::error::RobotError;
use super::kept::Limits;
use urdd_document::kept::keep;
use urdd_format::registry::{ModuleDocument, ModuleKind};

impl Robot {
    /// The largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none.
    ///
    /// # Errors
    /// If `bounds_module` is missing or unusable, or that of a legacy URDD, which has no speeds.
    pub fn velocity_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?.velocities)
    }

    /// The largest effort of each DOF, N m or N, as the source states it; infinite where it states none.
    ///
    /// # Errors
    /// As [`Robot::velocity_limits`].
    pub fn effort_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?.efforts)
    }

    fn limits(&self) -> Result<&Limits, RobotError> {
        keep(&self.limits, || {
            let part = self.part(&[ModuleKind::Bounds])?;
            let Some(ModuleDocument::Bounds(bounds)) = part.document(ModuleKind::Bounds) else {
                return Err(RobotError::Missing(ModuleKind::Bounds));
            };
            let numbers = |limits: &[Option<f64>]| {
                limits.iter().map(|limit| limit.unwrap_or(f64::INFINITY)).collect()
            };
            Ok(Limits {
                velocities: numbers(&bounds.dof_velocity_limits),
                efforts: numbers(&bounds.dof_effort_limits),
            })
        })
    }
}
