//! A robot that moves as its URDD says.

use nalgebra::Isometry3;

use urdd_robot::{Robot, RobotError};
use urdd_spheres::samples::Moves;

/// The robot, as its URDD moves.
pub(super) struct Moving<'a>(pub &'a Robot);

impl Moves for Moving<'_> {
    type Error = RobotError;

    fn start(&self) -> Result<Vec<f64>, RobotError> {
        Ok(self.0.configurations()?.zero())
    }

    fn sampled(&self, k: u64) -> Result<Vec<f64>, RobotError> {
        Ok(self.0.configurations()?.random(k))
    }

    fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, RobotError> {
        self.0.link_poses(configuration)
    }
}
