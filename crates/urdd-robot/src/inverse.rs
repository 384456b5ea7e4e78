//! Inverse kinematics.

use nalgebra::{Isometry3, Point3, UnitQuaternion};

use super::Robot;
use super::error::RobotError;
use super::robot::check_link;
use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::ConfigurationError;
use urdd_kinematics::inverse::{Conditions, Goal, Inverse, InverseSettings};

/// The target of inverse kinematics, in the root link's frame.
///
/// It is a position for a point of the link ([`Target::position`]), a rotation for the link ([`Target::rotation`]), or
/// both ([`Target::pose`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target(Goal);

impl Target {
    /// A target pose for the link's frame.
    pub fn pose(link: usize, pose: Isometry3<f64>) -> Self {
        Self::new(link, Some(pose.translation.vector.into()), Some(pose.rotation))
    }

    /// A target position for the origin of the link's frame, in metres. The link's rotation is free.
    pub fn position(link: usize, position: [f64; 3]) -> Self {
        Self::new(link, Some(position.into()), None)
    }

    /// A target rotation for the link's frame. The link's position is free.
    pub fn rotation(link: usize, rotation: UnitQuaternion<f64>) -> Self {
        Self::new(link, None, Some(rotation))
    }

    fn new(
        link: usize,
        position: Option<Point3<f64>>,
        rotation: Option<UnitQuaternion<f64>>,
    ) -> Self {
        Self(Goal { link, point: Point3::origin(), position, rotation, weights: None })
    }

    /// Multiplies the errors by factors of at least 0, before they are compared with the tolerances: those of the
    /// position along x, y, z, then of the rotation about x, y, z, along the axes of the target rotation, or of the
    /// root link's frame for a position alone. A factor of 0 leaves a direction free, such as the rotation of a tool
    /// about its own axis.
    pub fn weighted(mut self, weights: [f64; 6]) -> Self {
        self.0.weights = Some(weights);
        self
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

    /// An error for numbers that are not finite, weights below 0, or nothing to reach.
    fn check(&self) -> Result<(), RobotError> {
        let rotation = self.0.rotation.unwrap_or_else(UnitQuaternion::identity);
        let position = self.0.position.unwrap_or_else(Point3::origin);
        let numbers = self.0.point.iter().chain(position.iter());
        let mut numbers = numbers.chain(rotation.coords.iter());
        let weights = self.0.weights.unwrap_or([1.0; 6]);
        let counts =
            |k: usize| if k < 3 { self.0.position.is_some() } else { self.0.rotation.is_some() };
        let wrong = if !numbers.all(|x| x.is_finite()) {
            "the target is not finite"
        } else if !weights.iter().all(|x| x.is_finite() && *x >= 0.0) {
            "a weight is not finite, or below 0"
        } else if !(0..6).any(|k| counts(k) && weights[k] > 0.0) {
            "all weights of the target are 0: there is nothing to reach"
        } else {
            return Ok(());
        };
        Err(RobotError::Target(wrong))
    }
}

/// An error for settings that make no sense.
fn check(settings: &InverseSettings, dofs: usize) -> Result<(), RobotError> {
    let tolerances = [settings.position_tolerance, settings.rotation_tolerance];
    let bounds = settings.bounds.as_deref();
    let wrong = if !tolerances.iter().all(|tolerance| *tolerance >= 0.0) {
        "a tolerance is not a number, or below 0"
    } else if settings.iterations == 0 {
        "`iterations` is 0: at least 1 is needed, the default is 100"
    } else if bounds.is_some_and(|bounds| bounds.len() != dofs) {
        "the bounds are not one pair for each DOF"
    } else if bounds.unwrap_or_default().iter().any(|[lower, upper]| lower > upper) {
        "a lower bound is above its upper bound"
    } else {
        return Ok(());
    };
    Err(RobotError::Target(wrong))
}

impl Robot {
    /// Searches for a configuration within the bounds that reaches the target: by damped least squares from `start`,
    /// then from random configurations.
    ///
    /// Supports mimic joints and joints with several DOFs. A DOF that is
    /// [not limited](crate::Configurations::dof_is_limited) may also move as far from its start, and from the posture, as
    /// its bounds are from 0, unless the settings have bounds: an angle half a turn either way, a length one metre. So a
    /// continuous joint that follows a path does not jump by a turn, and its value may leave [-pi, pi].
    ///
    /// Where the robot has kinematic loops, the solution is closed: every step of the search is, from the closed
    /// configuration that [`Robot::close`] finds near its beginning. DOFs that loops tie to those that move the link move
    /// too, within their bounds. Set [`InverseSettings::open_loops`] for a solution of the spanning tree. If no closed one
    /// reaches the target, but one with open loops does, the verdict is [`Verdict::Loops`](crate::Verdict::Loops); if the
    /// loops cannot be closed at all, the configuration is that with the smallest gaps.
    ///
    /// Does not check for collisions: [`Robot::inverse_kinematics_where`] does. Returns the first solution within the
    /// tolerances, or the one that is nearest to a [posture](InverseSettings::posture); it depends only on the target,
    /// `start` and the settings. If there is none, the [verdict](crate::Verdict) says why.
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
    /// [`RobotError::OutOfRange`] for a link or locked DOF that is out of range; [`RobotError::Target`] for numbers
    /// that are not finite, tolerances or weights below 0, weights that leave nothing to reach, 0 iterations, crossed
    /// bounds, or not one pair of bounds for each DOF; [`RobotError::Configuration`] if `start` or the posture has the
    /// wrong length or a value that is not finite; and if `chain_module`, `dof_module` or `bounds_module` is missing or
    /// unusable, or, unless loops may be open, `loops_module` is unusable.
    pub fn inverse_kinematics(
        &self,
        target: &Target,
        start: &[f64],
        settings: &InverseSettings,
    ) -> Result<Inverse, RobotError> {
        let on = Cancellation::default();
        self.inverse_kinematics_where(target, start, settings, &|_| true, &on)
    }

    /// As [`Robot::inverse_kinematics`], for solutions that `accepts` allows: those without collision, for example, and
    /// at a distance from obstacles. The search goes on with other random configurations until one is allowed. If all
    /// are refused, the verdict is [`Verdict::Refused`](crate::Verdict::Refused), with the first of them. A cancellation
    /// takes effect before the next restart.
    ///
    /// ```
    /// use urdd_robot::{InverseSettings, Queries, Robot, RobotError, ShapeKind, Target, World};
    ///
    /// # fn ask(robot: &Robot, target: Target, world: &World) -> Result<(), RobotError> {
    /// let proximity = robot.proximity(ShapeKind::Pieces)?;
    /// let obstacles = proximity.world_proximity(world)?;
    /// let start = robot.configurations()?.zero();
    /// let is_free = |q: &[f64]| {
    ///     proximity.in_collision(q) == Ok(false) && obstacles.is_within(q, 0.01) == Ok(false)
    /// };
    /// let settings = InverseSettings::default();
    /// let found = robot.inverse_kinematics_where(&target, &start, &settings, &is_free, &Default::default())?;
    /// println!("{:?}", found.nearest().verdict);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// As there, and [`RobotError::Cancelled`].
    pub fn inverse_kinematics_where(
        &self,
        target: &Target,
        start: &[f64],
        settings: &InverseSettings,
        accepts: &dyn Fn(&[f64]) -> bool,
        cancellation: &Cancellation,
    ) -> Result<Inverse, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let known = self.configurations()?;
        let dofs = known.num_dofs();
        check_link(target.link(), kinematics.num_links())?;
        target.check()?;
        check(settings, dofs)?;
        if let Some(index) = settings.locked.iter().copied().find(|dof| *dof >= dofs) {
            return Err(RobotError::OutOfRange { what: "DOF", index, count: dofs });
        }
        let posture = settings.posture.as_deref().unwrap_or(start);
        for given in [start, posture] {
            ConfigurationError::check(given, dofs)?;
        }
        // What is not limited also moves as far from the start, and from the posture, as its bounds are from 0.
        let around = |k: usize| match (known.bounds()[k], known.dof_is_limited()[k]) {
            ([lower, upper], false) => {
                let [least, most] = [start[k].min(posture[k]), start[k].max(posture[k])];
                [lower + least.min(0.0), upper + most.max(0.0)]
            }
            (bounds, true) => bounds,
        };
        let own = || (0..dofs).map(around).collect();
        let bounds = settings.bounds.clone().unwrap_or_else(own);
        let space = known.space().with_bounds(&bounds);
        let space = space.ok_or(RobotError::Target("a bound is not finite"))?;
        let closure = if settings.open_loops { None } else { self.closure()? };
        let loops = closure.map(|closure| &closure.loops);
        let conditions = Conditions { accepts, stops: &|| cancellation.is_cancelled(), loops };
        let found = kinematics.reach(&target.0, start, &space, settings, &conditions)?;
        cancellation.check()?;
        Ok(found)
    }
}
