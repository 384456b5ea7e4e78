//! Inverse kinematics.

use nalgebra::{Isometry3, Point3, UnitQuaternion};

use super::Robot;
use super::error::RobotError;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::inverse::{Goal, Inverse, InverseSettings};

/// The target of inverse kinematics, in the root link's frame.
///
/// It is a position for a point of the link and, with [`Target::pose`], a rotation for the link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target(Goal);

impl Target {
    /// A target pose for the link's frame.
    pub fn pose(link: usize, pose: Isometry3<f64>) -> Self {
        Self(Goal {
            link,
            point: Point3::origin(),
            position: pose.translation.vector.into(),
            rotation: Some(pose.rotation),
        })
    }

    /// A target position for the origin of the link's frame, in metres. The link's rotation is free.
    pub fn position(link: usize, position: [f64; 3]) -> Self {
        Self(Goal {
            link,
            point: Point3::origin(),
            position: position.into(),
            rotation: None,
        })
    }

    /// Applies the target position to another point of the link, such as a tool tip, instead of the origin of its
    /// frame: in the link's frame, in metres. The target rotation remains that of the link's frame.
    pub fn of_point(mut self, point: [f64; 3]) -> Self {
        self.0.point = point.into();
        self
    }

    /// The link.
    pub fn link(&self) -> usize {
        self.0.link
    }

    fn is_finite(&self) -> bool {
        let rotation = self.0.rotation.unwrap_or_else(UnitQuaternion::identity);
        let numbers = self.0.point.iter().chain(self.0.position.iter());
        numbers.chain(rotation.coords.iter()).all(|x| x.is_finite())
    }
}

impl Robot {
    /// Searches for a configuration within the bounds that reaches the target: by damped least squares from `start`,
    /// then from random configurations.
    ///
    /// Supports mimic joints and joints with several DOFs. Does not check for self-collision. Returns the first
    /// solution within the tolerances; it depends only on the target, `start` and the settings.
    ///
    /// ```
    /// use urdd_robot::{Inverse, InverseSettings, Robot, Target};
    ///
    /// # let folder = tempfile::tempdir()?;
    /// # let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/../../conformance/robots/welding_arm.urdf");
    /// # let path = folder.path().join("welding_arm");
    /// # urdd_generate::generate(urdf.as_ref(), &path, &Default::default(), &())?;
    /// let robot = Robot::open(&path)?;
    /// let torch = robot.link("torch")?;
    /// let start = robot.configurations()?.zero();
    ///
    /// // 5 cm along the x axis of the root link, turned as before.
    /// let mut pose = robot.link_poses(&start)?[torch];
    /// pose.translation.x -= 0.05;
    /// match robot.inverse_kinematics(&Target::pose(torch, pose), &start, &InverseSettings::default())? {
    ///     Inverse::Reached(found) => {
    ///         let there = robot.link_poses(&found.configuration)?[torch];
    ///         assert!((there.translation.vector - pose.translation.vector).norm() < 1e-6);
    ///     }
    ///     Inverse::Nearest(found) => println!("{} m are left", found.position_error),
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a link index that is out of range; [`RobotError::Target`] if the target or the
    /// bounds of the settings are not finite, or if there is not one pair of bounds for each DOF;
    /// [`RobotError::Configuration`] if `start` has the wrong length or a value that is not finite; and if
    /// `chain_module`, `dof_module` or `bounds_module` is missing or unusable.
    pub fn inverse_kinematics(
        &self,
        target: &Target,
        start: &[f64],
        settings: &InverseSettings,
    ) -> Result<Inverse, RobotError> {
        self.inverse_kinematics_cancellable(target, start, settings, &Cancellation::default())
    }

    /// As [`Robot::inverse_kinematics`], with cancellation, which takes effect before the next restart.
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn inverse_kinematics_cancellable(
        &self,
        target: &Target,
        start: &[f64],
        settings: &InverseSettings,
        cancellation: &Cancellation,
    ) -> Result<Inverse, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let space = self.configurations()?;
        let (link, count) = (target.link(), kinematics.num_links());
        if link >= count {
            let (what, index) = ("link", link);
            return Err(RobotError::OutOfRange { what, index, count });
        }
        if !target.is_finite() {
            return Err(RobotError::Target("the target is not finite"));
        }
        let space = match &settings.bounds {
            None => space.space(),
            Some(bounds) if bounds.len() != kinematics.num_dofs() => {
                return Err(RobotError::Target(
                    "the bounds are not one pair for each DOF",
                ));
            }
            Some(bounds) => &space
                .space()
                .with_bounds(bounds)
                .ok_or(RobotError::Target("a bound is not finite"))?,
        };
        let stop = || cancellation.is_cancelled();
        let found = kinematics.reach(&target.0, start, space, settings, &stop)?;
        cancellation.check()?;
        Ok(found)
    }
}
