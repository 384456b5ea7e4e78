//! The speeds and efforts of DOFs.

use super::Robot;
use super::error::RobotError;
use urdd_format::registry::{ModuleDocument, ModuleKind};

impl Robot {
    /// The largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none.
    ///
    /// # Errors
    /// If `bounds_module` is missing or unusable, or that of a legacy URDD, which has no speeds.
    pub fn velocity_limits(&self) -> Result<Vec<f64>, RobotError> {
        Ok(self.limits()?.map(|(velocity, _)| velocity).collect())
    }

    /// The largest effort of each DOF, N m or N, as the source states it; infinite where it states none.
    ///
    /// # Errors
    /// As [`Robot::velocity_limits`].
    pub fn effort_limits(&self) -> Result<Vec<f64>, RobotError> {
        Ok(self.limits()?.map(|(_, effort)| effort).collect())
    }

    /// The speed and the effort of each DOF.
    fn limits(&self) -> Result<impl Iterator<Item = (f64, f64)> + use<>, RobotError> {
        let part = self.part(&[ModuleKind::Bounds])?;
        let Some(ModuleDocument::Bounds(bounds)) = part.document(ModuleKind::Bounds) else {
            return Err(RobotError::Missing(ModuleKind::Bounds));
        };
        let number = |limit: Option<f64>| limit.unwrap_or(f64::INFINITY);
        let speeds = bounds.dof_velocity_limits.clone().into_iter().map(number);
        let efforts = bounds.dof_effort_limits.clone().into_iter().map(number);
        Ok(speeds.zip(efforts))
    }
}
