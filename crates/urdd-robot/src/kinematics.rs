//! Forward kinematics: link poses and Jacobians.

use nalgebra::{Isometry3, Matrix6xX, Point3};

use super::Robot;
use super::batch::{check_room, fill, room};
use super::error::RobotError;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::Place;

/// 6 rows, one column for each DOF: linear velocity, then angular velocity.
pub type Jacobian = Matrix6xX<f64>;

/// Configurations in one block of work.
const BLOCK: usize = 64;

impl Robot {
    /// The pose of each link in the root link's frame, in link order.
    ///
    /// # Errors
    /// [`RobotError::Configuration`] if the length differs from the number of DOFs or a value is not finite; and if
    /// `chain_module` or `dof_module` is missing or unusable. Values beyond the bounds are allowed.
    pub fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, RobotError> {
        Ok(self.motion()?.kinematics.link_poses(configuration)?)
    }

    /// As [`Robot::link_poses`], into a reusable vector.
    ///
    /// # Errors
    /// As [`Robot::link_poses`].
    pub fn link_poses_into(
        &self,
        configuration: &[f64],
        poses: &mut Vec<Isometry3<f64>>,
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        Ok(kinematics.link_poses_into(configuration, poses)?)
    }

    /// The pose of a link in the frame of another one.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link index that is out of range; and as [`Robot::link_poses`].
    pub fn relative_pose(
        &self,
        configuration: &[f64],
        link: usize,
        relative_to: usize,
    ) -> Result<Isometry3<f64>, RobotError> {
        let poses = self.link_poses(configuration)?;
        let [link, base] = [link, relative_to].map(|index| {
            let (what, count) = ("link", poses.len());
            let none = RobotError::OutOfRange { what, index, count };
            poses.get(index).ok_or(none)
        });
        Ok(base?.inv_mul(link?))
    }

    /// The DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link index that is out of range; and as [`Robot::link_names`].
    pub fn dofs_between(&self, base: usize, tip: usize) -> Result<Vec<usize>, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let count = kinematics.num_links();
        for index in [base, tip] {
            if index >= count {
                let what = "link";
                return Err(RobotError::OutOfRange { what, index, count });
            }
        }
        Ok(kinematics.dofs_between(base, tip))
    }

    /// The poses of all links for a batch of configurations, stored one after another in `configurations`: pose
    /// `k * links + link` is that of `link` in configuration `k`. Runs on rayon's thread pool, without allocations per
    /// configuration.
    ///
    /// # Errors
    /// [`RobotError::Batch`] if the number of values is not a multiple of the number of DOFs; [`RobotError::Memory`] if
    /// there is not enough memory; and as [`Robot::link_poses`], for the first invalid configuration.
    pub fn link_poses_batch(
        &self,
        configurations: &[f64],
    ) -> Result<Vec<Isometry3<f64>>, RobotError> {
        let motion = self.motion()?;
        let kinematics = &motion.kinematics;
        let (dofs, links) = (kinematics.num_dofs(), kinematics.num_links());
        let count = motion.batch(configurations)?;
        let mut poses = room(count, links)?;
        let write = |scratch: &mut Vec<Isometry3<f64>>, k: usize, out: &mut [Isometry3<f64>]| {
            kinematics.link_poses_into(&configurations[k * dofs..(k + 1) * dofs], scratch)?;
            out.copy_from_slice(scratch);
            Ok::<(), RobotError>(())
        };
        let scratch = || Vec::with_capacity(links);
        fill(&mut poses, links, BLOCK, scratch, write)?;
        Ok(poses)
    }

    /// The geometric Jacobian of a link's frame: 6 rows, one column for each DOF. Rows 0 to 2 are the linear velocity
    /// of the frame's origin, rows 3 to 5 the angular velocity, both expressed in the root link's frame. A mimic joint
    /// contributes to the column of the DOF that it follows. The columns of a rotation vector are derivatives with
    /// respect to its components.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link index that is out of range; and as [`Robot::link_poses`].
    pub fn jacobian(&self, configuration: &[f64], link: usize) -> Result<Jacobian, RobotError> {
        self.jacobian_at(configuration, link, [0.0; 3])
    }

    /// As [`Robot::jacobian`], for a point in the link's frame, in metres.
    ///
    /// # Errors
    /// As [`Robot::jacobian`].
    pub fn jacobian_at(
        &self,
        configuration: &[f64],
        link: usize,
        point: [f64; 3],
    ) -> Result<Jacobian, RobotError> {
        let mut jacobian = Jacobian::zeros(self.motion()?.kinematics.num_dofs());
        let out = jacobian.as_mut_slice();
        self.jacobian_into(configuration, link, point, &mut Vec::new(), out)?;
        Ok(jacobian)
    }

    /// As [`Robot::jacobian_at`], into `out`: column-major, 6 values for each DOF. `poses` is reusable, and becomes
    /// the poses of all links.
    ///
    /// # Errors
    /// As [`Robot::jacobian`]; [`RobotError::Room`] if the length of `out` differs from 6 for each DOF.
    pub fn jacobian_into(
        &self,
        configuration: &[f64],
        link: usize,
        point: [f64; 3],
        poses: &mut Vec<Isometry3<f64>>,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        check_room(out.len(), kinematics.num_dofs(), 6)?;
        kinematics.link_poses_into(configuration, poses)?;
        let count = poses.len();
        let pose =
            poses.get(link).ok_or(RobotError::OutOfRange { what: "link", index: link, count })?;
        let point = pose * Point3::from(point);
        kinematics.jacobian_into(configuration, poses, link, &point, out);
        Ok(())
    }

    /// The Jacobians of a link's frame for a batch of configurations, stored one after another in `configurations`: as
    /// [`Robot::jacobian`], in column-major order. Value `(k * dofs + dof) * 6 + row` is the entry of row `row` and DOF
    /// `dof` in configuration `k`. Evaluates only the joints that move the link. Runs on rayon's thread pool, without
    /// allocations per configuration.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link index that is out of range; [`RobotError::Batch`] if the number of values
    /// is not a multiple of the number of DOFs; [`RobotError::Memory`] if there is not enough memory; and as
    /// [`Robot::link_poses`], for the first configuration without a pose of the link.
    pub fn jacobian_batch(
        &self,
        configurations: &[f64],
        link: usize,
    ) -> Result<Vec<f64>, RobotError> {
        let motion = self.motion()?;
        let width = 6 * motion.kinematics.num_dofs();
        let mut jacobians = room(motion.batch(configurations)?, width)?;
        let on = Cancellation::default();
        self.jacobian_batch_into(configurations, link, [0.0; 3], &on, &mut jacobians)?;
        Ok(jacobians)
    }

    /// As [`Robot::jacobian_batch`], for a point in the link's frame, in metres, into `out`.
    ///
    /// # Errors
    /// As there; [`RobotError::Room`] if the length of `out` differs from the number of results, and
    /// [`RobotError::Cancelled`].
    pub fn jacobian_batch_into(
        &self,
        configurations: &[f64],
        link: usize,
        point: [f64; 3],
        cancellation: &Cancellation,
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let motion = self.motion()?;
        let kinematics = &motion.kinematics;
        let (dofs, count) = (kinematics.num_dofs(), kinematics.num_links());
        if link >= count {
            let (what, index) = ("link", link);
            return Err(RobotError::OutOfRange { what, index, count });
        }
        check_room(out.len(), motion.batch(configurations)?, 6 * dofs)?;
        let (branch, point) = (kinematics.branch(link), Point3::from(point));
        fill(out, 6 * dofs, BLOCK, Place::default, |place, k, out| {
            cancellation.check()?;
            let q = &configurations[k * dofs..(k + 1) * dofs];
            Ok(branch.jacobian_into(q, &point, place, out)?)
        })
    }
}
