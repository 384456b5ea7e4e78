//! Statics: what each DOF must give to hold the robot still against gravity.

use nalgebra::Vector3;

use super::Robot;
use super::batch::{check_room, room};
use super::error::RobotError;
use super::names::check_link;
use super::workspace::with_workspace;
use urdd_kinematics::{Load, fill};

/// Configurations in one block of work.
const BLOCK: usize = 64;

/// What acts on a robot that is held still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GravitySettings {
    /// The acceleration due to gravity, m/s², in the root link's frame; (0, 0, -9.81) by default.
    pub gravity: [f64; 3],
    /// What a link carries; nothing by default.
    pub payload: Option<Payload>,
}

/// A mass that a link carries, beside those of the URDF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Payload {
    /// The link.
    pub link: usize,
    /// kg.
    pub mass: f64,
    /// Where its centre of mass is, in the link's frame, m.
    pub point: [f64; 3],
}

impl Default for GravitySettings {
    fn default() -> Self {
        GravitySettings { gravity: [0.0, 0.0, -9.81], payload: None }
    }
}

impl GravitySettings {
    fn check(&self, num_links: usize) -> Result<(), RobotError> {
        if !self.gravity.iter().all(|x| x.is_finite()) {
            return Err(RobotError::Setting("gravity is three finite numbers, m/s²"));
        }
        let Some(Payload { link, mass, point }) = self.payload else {
            return Ok(());
        };
        check_link(link, num_links)?;
        if !(mass.is_finite() && mass >= 0.0) {
            return Err(RobotError::Setting("a payload's mass is finite, and not below 0 kg"));
        }
        match point.iter().all(|x| x.is_finite()) {
            true => Ok(()),
            false => Err(RobotError::Setting("a payload's point is three finite numbers, m")),
        }
    }
}

/// The torque (N m) or force (N) of each DOF that holds the robot still against gravity, in DOF order.
///
/// It is what the motors must give, as Pinocchio's `computeGeneralizedGravity`: the derivative of the potential energy with
/// respect to the DOF, and positive where the DOF must push toward larger values. Masses and centres of mass are those of
/// [`Robot::link_masses`]. A mimic joint counts for the DOF that it follows, times its multiplier. The values of a rotation
/// vector (floating and spherical joints) are derivatives with respect to its components.
///
/// Each method fails as [`Robot::link_poses`] and [`Robot::link_masses`], with [`RobotError::OutOfRange`] for the link of a
/// payload, and with [`RobotError::Setting`] for a number of the settings that is not finite, or a mass below 0.
impl Robot {
    /// The torques and forces in a configuration.
    pub fn gravity_torques(
        &self,
        configuration: &[f64],
        settings: &GravitySettings,
    ) -> Result<Vec<f64>, RobotError> {
        let mut torques = vec![0.0; self.motion()?.kinematics.num_dofs()];
        self.gravity_torques_into(configuration, settings, &mut torques)?;
        Ok(torques)
    }

    /// As [`Robot::gravity_torques`], into `out`. It does not allocate after the first of a thread.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the length of `out` differs from the number of DOFs.
    pub fn gravity_torques_into(
        &self,
        configuration: &[f64],
        settings: &GravitySettings,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let (kinematics, masses) = (&self.motion()?.kinematics, self.link_masses()?);
        check_room(out.len(), 1, kinematics.num_dofs())?;
        settings.check(kinematics.num_links())?;
        with_workspace(|workspace| {
            let (poses, loads) = (&mut workspace.placed.poses, &mut workspace.loads);
            kinematics.link_poses_into(configuration, poses)?;
            let own = masses.iter().zip(&*poses);
            loads.clear();
            loads.extend(own.map(|(own, pose)| Load::new(own.mass, own.centre.into(), pose)));
            // A URDD that is not valid may have another number of links in `urdf_module`.
            loads.resize(poses.len(), Load::default());
            if let Some(Payload { link, mass, point }) = settings.payload {
                loads[link] += Load::new(mass, point.into(), &poses[link]);
            }
            let gravity = Vector3::from(settings.gravity);
            kinematics.gravity_torques_into(configuration, poses, &gravity, loads, out);
            Ok(())
        })
    }

    /// As [`Robot::gravity_torques`], for a batch of configurations, stored one after another in `configurations`: value
    /// `k * dofs + dof` is that of `dof` in configuration `k`. Runs on rayon's thread pool.
    ///
    /// # Errors
    /// [`RobotError::Batch`] and [`RobotError::Memory`].
    pub fn gravity_torques_batch(
        &self,
        configurations: &[f64],
        settings: &GravitySettings,
    ) -> Result<Vec<f64>, RobotError> {
        let motion = self.motion()?;
        let (dofs, rows) = (motion.kinematics.num_dofs(), motion.rows(configurations)?);
        let mut torques = room(rows.count, dofs)?;
        fill(&mut torques, dofs, BLOCK, |(): &mut (), k, out| {
            self.gravity_torques_into(rows.row(k), settings, out)
        })?;
        Ok(torques)
    }
}
