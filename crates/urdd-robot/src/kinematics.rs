//! Forward kinematics: link poses and Jacobians; and statics: what each DOF must give to hold the robot still against
//! gravity.

use nalgebra::{Isometry3, Matrix6xX, Point3, Vector3};

use super::Robot;
use super::batch::{check_room, room};
use super::error::RobotError;
use super::kept::LinkMass;
use super::robot::check_link;
use super::workspace::{Workspace, with_workspace};
use urdd_directory::cancellation::Cancellation;
use urdd_document::kept::keep;
use urdd_format::urdf::Link;
use urdd_kinematics::{Load, Place, fill};

/// 6 rows, one column for each DOF: linear velocity, then angular velocity.
pub type Jacobian = Matrix6xX<f64>;

/// Configurations in one block of work.
const BLOCK: usize = 64;

/// Poses and Jacobians.
///
/// Each method fails with [`RobotError::Configuration`] if the length of a configuration differs from the number of DOFs or
/// a value is not finite, a batch for the first such configuration; with [`RobotError::OutOfRange`] for a link index that
/// is out of range; and if `chain_module` or `dof_module` is missing or unusable. A batch also fails with
/// [`RobotError::Batch`] if the number of values is not a multiple of the number of DOFs, and with [`RobotError::Memory`]
/// if there is not enough memory.
impl Robot {
    /// The pose of each link in the root link's frame, in link order. Values beyond the bounds are allowed.
    pub fn link_poses(&self, configuration: &[f64]) -> Result<Vec<Isometry3<f64>>, RobotError> {
        Ok(self.motion()?.kinematics.link_poses(configuration)?)
    }

    /// As [`Robot::link_poses`], into a reusable vector.
    pub fn link_poses_into(
        &self,
        configuration: &[f64],
        poses: &mut Vec<Isometry3<f64>>,
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        Ok(kinematics.link_poses_into(configuration, poses)?)
    }

    /// The pose of a link in the frame of another one.
    pub fn relative_pose(
        &self,
        configuration: &[f64],
        link: usize,
        relative_to: usize,
    ) -> Result<Isometry3<f64>, RobotError> {
        let poses = self.link_poses(configuration)?;
        check_link(relative_to, poses.len())?;
        check_link(link, poses.len())?;
        Ok(poses[relative_to].inv_mul(&poses[link]))
    }

    /// The DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
    pub fn dofs_between(&self, base: usize, tip: usize) -> Result<Vec<usize>, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        for link in [base, tip] {
            check_link(link, kinematics.num_links())?;
        }
        Ok(kinematics.dofs_between(base, tip))
    }

    /// The poses of all links for a batch of configurations, stored one after another in `configurations`: pose
    /// `k * links + link` is that of `link` in configuration `k`. Runs on rayon's thread pool, without allocations per
    /// configuration.
    pub fn link_poses_batch(
        &self,
        configurations: &[f64],
    ) -> Result<Vec<Isometry3<f64>>, RobotError> {
        let motion = self.motion()?;
        let kinematics = &motion.kinematics;
        let (links, rows) = (kinematics.num_links(), motion.rows(configurations)?);
        let mut poses = room(rows.count, links)?;
        fill(&mut poses, links, BLOCK, |scratch: &mut Vec<_>, k, out| {
            kinematics.link_poses_into(rows.row(k), scratch)?;
            out.copy_from_slice(scratch);
            Ok::<(), RobotError>(())
        })?;
        Ok(poses)
    }

    /// The geometric Jacobian of a link's frame: 6 rows, one column for each DOF. Rows 0 to 2 are the linear velocity
    /// of the frame's origin, rows 3 to 5 the angular velocity, both expressed in the root link's frame. A mimic joint
    /// contributes to the column of the DOF that it follows. The columns of a rotation vector are derivatives with
    /// respect to its components.
    pub fn jacobian(&self, configuration: &[f64], link: usize) -> Result<Jacobian, RobotError> {
        self.jacobian_at(configuration, link, [0.0; 3])
    }

    /// As [`Robot::jacobian`], for a point in the link's frame, in metres.
    pub fn jacobian_at(
        &self,
        configuration: &[f64],
        link: usize,
        point: [f64; 3],
    ) -> Result<Jacobian, RobotError> {
        let mut jacobian = Jacobian::zeros(self.motion()?.kinematics.num_dofs());
        self.jacobian_into(configuration, link, point, jacobian.as_mut_slice())?;
        Ok(jacobian)
    }

    /// As [`Robot::jacobian_at`], into `out`: column-major, 6 values for each DOF. It does not allocate after the first
    /// of a thread.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the length of `out` differs from 6 for each DOF.
    pub fn jacobian_into(
        &self,
        configuration: &[f64],
        link: usize,
        point: [f64; 3],
        out: &mut [f64],
    ) -> Result<(), RobotError> {
        let kinematics = &self.motion()?.kinematics;
        check_room(out.len(), kinematics.num_dofs(), 6)?;
        with_workspace(|Workspace { placed, .. }| {
            let poses = &mut placed.poses;
            kinematics.link_poses_into(configuration, poses)?;
            check_link(link, poses.len())?;
            let point = poses[link] * Point3::from(point);
            kinematics.jacobian_into(configuration, poses, link, &point, out);
            Ok(())
        })
    }

    /// The Jacobians of a link's frame for a batch of configurations, stored one after another in `configurations`: as
    /// [`Robot::jacobian`], in column-major order. Value `(k * dofs + dof) * 6 + row` is the entry of row `row` and DOF
    /// `dof` in configuration `k`. Evaluates only the joints that move the link. Runs on rayon's thread pool, without
    /// allocations per configuration.
    pub fn jacobian_batch(
        &self,
        configurations: &[f64],
        link: usize,
    ) -> Result<Vec<f64>, RobotError> {
        let motion = self.motion()?;
        let width = 6 * motion.kinematics.num_dofs();
        let mut jacobians = room(motion.rows(configurations)?.count, width)?;
        let on = Cancellation::default();
        self.jacobian_batch_into(configurations, link, [0.0; 3], &on, &mut jacobians)?;
        Ok(jacobians)
    }

    /// As [`Robot::jacobian_batch`], for a point in the link's frame, in metres, into `out`.
    ///
    /// # Errors
    /// [`RobotError::Room`] if the length of `out` differs from the number of results, and [`RobotError::Cancelled`].
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
        check_link(link, kinematics.num_links())?;
        let (width, rows) = (6 * kinematics.num_dofs(), motion.rows(configurations)?);
        check_room(out.len(), rows.count, width)?;
        let (branch, point) = (kinematics.branch(link), Point3::from(point));
        fill(out, width, BLOCK, |place: &mut Place, k, out| {
            cancellation.check()?;
            Ok(branch.jacobian_into(rows.row(k), &point, place, out)?)
        })
    }
}

impl Robot {
    /// The mass of each link, and its centre of mass.
    ///
    /// # Errors
    /// If `urdf_module` is missing or unusable.
    pub fn link_masses(&self) -> Result<&[LinkMass], RobotError> {
        let of = |link: Link| {
            let inertial = link.inertial?;
            let origin = inertial.origin.and_then(|origin| origin.xyz);
            Some(LinkMass { mass: inertial.mass?.value, centre: origin.unwrap_or_default() })
        };
        keep(&self.masses, || {
            let links = self.description()?.links.into_iter();
            Ok(links.map(|link| of(link).unwrap_or_default()).collect())
        })
        .map(Vec::as_slice)
    }

    /// The centre of mass of the robot, in the root link's frame, m; `None` if it has no mass.
    ///
    /// # Errors
    /// As [`Robot::link_poses`] and [`Robot::link_masses`].
    pub fn centre_of_mass(&self, configuration: &[f64]) -> Result<Option<[f64; 3]>, RobotError> {
        let poses = self.link_poses(configuration)?;
        let mut all = Load::default();
        for (link, pose) in self.link_masses()?.iter().zip(&poses) {
            all += Load::new(link.mass, link.centre.into(), pose);
        }
        Ok((all.mass > 0.0).then(|| (all.moment / all.mass).into()))
    }
}

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
        let Some(Payload { link, mass, point }) = self.payload else { return Ok(()) };
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
