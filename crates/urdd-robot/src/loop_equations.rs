//! The equations of kinematic loops: which DOFs move freely, what is not 0 that should be, its derivatives, and velocities
//! that keep loops closed.

use nalgebra::DMatrix;

use super::Robot;
use super::batch::check_room;
use super::error::RobotError;
use super::workspace::{ClosingSpace, with_closing_space, with_workspace};
use urdd_kinematics::ConfigurationError;
use urdd_kinematics::loops::Mobility;

/// One row for each equation, one column for each DOF.
pub type LoopJacobian = DMatrix<f64>;

/// The equations of loops and couplings. A tree has none.
///
/// Each method fails as [`Robot::loop_errors`].
impl Robot {
    /// The DOFs that move freely, ascending, as `loops_module` states them; the others follow from them near its reference
    /// configuration. All DOFs for a tree.
    pub fn independent_dofs(&self) -> Result<Vec<usize>, RobotError> {
        let all = || Ok((0..self.motion()?.kinematics.num_dofs()).collect());
        self.closure()?.map_or_else(all, |closure| Ok(closure.independent.clone()))
    }

    /// The number of [`Robot::independent_dofs`].
    pub fn num_independent_dofs(&self) -> Result<usize, RobotError> {
        let dofs = self.motion()?.kinematics.num_dofs();
        Ok(self.closure()?.map_or(dofs, |closure| closure.independent.len()))
    }

    /// Which DOFs move freely at a closed configuration, and which follow: as [`Robot::independent_dofs`], as far as the
    /// others follow from these there (SPEC 6.8.7). Where several links are in a line, more may move freely.
    pub fn free_dofs(&self, configuration: &[f64]) -> Result<Mobility, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let poses = kinematics.link_poses(configuration)?;
        let Some(closure) = self.closure()? else {
            let independent = (0..kinematics.num_dofs()).collect();
            return Ok(Mobility { independent, dependent: Vec::new() });
        };
        let rank = |dof: usize| u8::from(closure.is_independent[dof]);
        Ok(closure.loops.mobility(kinematics, configuration, &poses, rank))
    }

    /// The number of equations of all loops and couplings: 0 for a tree. A loop of kind `Fixed` has 6; `Revolute` and
    /// `Prismatic` 5; `Cylindrical` and `Universal` 4; `Spherical` and `Planar` 3; a coupling 1.
    pub fn num_loop_equations(&self) -> Result<usize, RobotError> {
        Ok(self.closure()?.map_or(0, |closure| closure.loops.num_equations()))
    }

    /// The left-hand side of each equation, which is 0 where it holds: for each loop those of its kind, then the sum of
    /// each coupling. With the pose of frame B in frame A, of position p and rotation R, a loop has the components of p
    /// that it holds, m; then the rotation vector of R if it holds the rotation, the x and y components of R ez if it holds
    /// the direction of z, or the z component of R ez if it holds the right angle.
    pub fn loop_residuals(&self, configuration: &[f64]) -> Result<Vec<f64>, RobotError> {
        let mut residuals = vec![0.0; self.num_loop_equations()?];
        self.loop_residuals_into(configuration, &mut residuals)?;
        Ok(residuals)
    }

    /// As [`Robot::loop_residuals`], into `out`. It does not allocate after the first of a thread.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the length of `out` differs from the number of equations.
    pub fn loop_residuals_into(
        &self,
        configuration: &[f64],
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        check_room(out.len(), 1, self.num_loop_equations()?)?;
        let closure = self.closure()?;
        with_workspace(|workspace| {
            let poses = &mut workspace.placed.poses;
            kinematics.link_poses_into(configuration, poses)?;
            if let Some(closure) = closure {
                closure.loops.equations_into(configuration, poses, out);
            }
            Ok(())
        })
    }

    /// The derivatives of the equations: one row for each, in the order of [`Robot::loop_residuals`], and one column for
    /// each DOF. Velocities keep the loops closed where this matrix times them is 0. The rows of a rotation that a loop
    /// holds are the angular velocity of frame B relative to frame A, in the axes of frame A. A mimic joint counts for the
    /// DOF that it follows; the columns of a rotation vector are derivatives by its components. Rows that say the same as
    /// others are normal: of the five of a planar four-bar, three.
    pub fn loop_jacobian(&self, configuration: &[f64]) -> Result<LoopJacobian, RobotError> {
        let dofs = self.motion()?.kinematics.num_dofs();
        let mut jacobian = LoopJacobian::zeros(self.num_loop_equations()?, dofs);
        self.loop_jacobian_into(configuration, jacobian.as_mut_slice())?;
        Ok(jacobian)
    }

    /// As [`Robot::loop_jacobian`], into `out`: column-major, a value for each equation for each DOF. It does not allocate
    /// after the first of a thread.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the length of `out` differs from the number of equations times that of DOFs.
    pub fn loop_jacobian_into(
        &self,
        configuration: &[f64],
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        check_room(out.len(), kinematics.num_dofs(), self.num_loop_equations()?)?;
        let closure = self.closure()?;
        with_workspace(|workspace| {
            let poses = &mut workspace.placed.poses;
            kinematics.link_poses_into(configuration, poses)?;
            if let Some(closure) = closure {
                let loops = &closure.loops;
                loops.equations_jacobian_into(kinematics, configuration, poses, out);
            }
            Ok(())
        })
    }

    /// The velocities of all DOFs, rad/s or m/s, that keep the loops closed, for those of the independent DOFs, in the
    /// order of [`Robot::independent_dofs`]: by least squares, with the rank as SPEC 6.8.7 decides it. `None` where the
    /// others do not follow from the independent DOFs: at a dead point, or where parts are in a line and more moves freely.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the number of velocities differs from that of independent DOFs, and [`RobotError::Setting`]
    /// for one that is not finite.
    pub fn loop_velocities(
        &self,
        configuration: &[f64],
        independent: &[f64],
    ) -> Result<Option<Vec<f64>>, RobotError> {
        let mut velocities = vec![0.0; self.motion()?.kinematics.num_dofs()];
        let found = self.loop_velocities_into(configuration, independent, &mut velocities)?;
        Ok(found.then_some(velocities))
    }

    /// As [`Robot::loop_velocities`], into `out`: false instead of `None`. It does not allocate after the first of a
    /// thread.
    ///
    /// # Errors
    /// As there, and [`RobotError::Room`] if the length of `out` differs from the number of DOFs.
    pub fn loop_velocities_into(
        &self,
        configuration: &[f64],
        independent: &[f64],
        out: &mut [f64],
    ) -> Result<bool, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let dofs = kinematics.num_dofs();
        let closure = self.closure()?;
        check_room(independent.len(), 1, self.num_independent_dofs()?)?;
        check_room(out.len(), 1, dofs)?;
        ConfigurationError::check(configuration, dofs)?;
        if !independent.iter().all(|velocity| velocity.is_finite()) {
            return Err(RobotError::Setting("velocities are finite, rad/s or m/s"));
        }
        let Some(closure) = closure else {
            out.copy_from_slice(independent);
            return Ok(true);
        };
        out.fill(0.0);
        closure.independent.iter().zip(independent).for_each(|(dof, value)| out[*dof] = *value);
        with_workspace(|workspace| {
            let poses = &mut workspace.placed.poses;
            kinematics.link_poses_into(configuration, poses)?;
            with_closing_space(|ClosingSpace { velocities, .. }| {
                let given = |dof: usize| closure.is_independent[dof];
                let loops = &closure.loops;
                Ok(loops.velocities(kinematics, configuration, poses, given, out, velocities))
            })
        })
    }
}
