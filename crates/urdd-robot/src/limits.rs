//! The speeds and efforts of DOFs.

use super::Robot;
use super::error::RobotError;
use urdd_document::kept::keep;
use urdd_format::registry::{ModuleDocument, ModuleKind};

/// Each method fails if `bounds_module` is missing or unusable, or that of a legacy URDD, which has neither.
impl Robot {
    /// The largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none.
    pub fn velocity_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[0])
    }

    /// The largest effort of each DOF, N m or N, as the source states it; infinite where it states none.
    pub fn effort_limits(&self) -> Result<&[f64], RobotError> {
        Ok(&self.limits()?[1])
    }

    fn limits(&self) -> Result<&[Vec<f64>; 2], RobotError> {
        keep(&self.limits, || {
            let part = self.part(&[ModuleKind::Bounds])?;
            let Some(ModuleDocument::Bounds(bounds)) = part.document_v1(ModuleKind::Bounds) else {
                return Err(RobotError::Missing(ModuleKind::Bounds));
            };
            let limits = [&bounds.dof_velocity_limits, &bounds.dof_effort_limits];
            Ok(limits.map(|all| all.iter().map(|limit| limit.unwrap_or(f64::INFINITY)).collect()))
        })
    }
}
