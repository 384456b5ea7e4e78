//! Kinematic loops in use: how far a configuration is from closed, and the nearest closed one.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::Robot;
use super::batch::{check_room, room};
use super::error::RobotError;
use super::kept::Closure;
use super::workspace::{ClosingSpace, with_closing_space, with_workspace};
use urdd_directory::cancellation::Cancellation;
use urdd_document::kept::keep;
use urdd_format::loops::LoopsModule;
use urdd_format::registry::{ModuleDocument, ModuleKind};
use urdd_kinematics::loops::{Gap, NotClosed};
use urdd_kinematics::{ConfigurationError, fill};

/// Configurations in one block of work.
const BLOCK: usize = 8;

/// How far a configuration is from closed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LoopErrors {
    /// For each loop of `loops_module`, its gap: m and rad (SPEC 6.8.3).
    pub gaps: Vec<Gap>,
    /// For each coupling, its sum, which is 0 where it holds (SPEC 6.8.5).
    pub sums: Vec<f64>,
    /// Whether all loops are closed and all couplings hold, within their tolerances (SPEC 6.8.4, 6.8.5).
    pub is_closed: bool,
}

/// What may move when loops are closed, and how far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CloseSettings<'a> {
    /// DOFs that keep their value. Others that no loop or coupling depends on keep theirs too, but for the bounds.
    pub held: &'a [usize],
    /// For each DOF, the lower and the upper bound, which may be infinite. By default those of `bounds_module`; a DOF that
    /// is [not limited](crate::Configurations::dof_is_limited) has none.
    pub bounds: Option<&'a [[f64; 2]]>,
}

/// The answer of [`Robot::close`].
#[derive(Debug, Clone, PartialEq)]
pub enum Closed {
    /// A configuration in which all loops are closed and all couplings hold.
    Closed(Vec<f64>),
    /// None was found from there: the one with the smallest gaps. As a rule, the loops cannot close with what is held and
    /// bounded. This is a search, not a proof.
    Apart(Vec<f64>),
}

impl Closed {
    /// Whether all loops are closed and all couplings hold.
    pub fn is_closed(&self) -> bool {
        matches!(self, Closed::Closed(_))
    }

    /// The configuration, closed or not.
    pub fn configuration(&self) -> &[f64] {
        let (Closed::Closed(configuration) | Closed::Apart(configuration)) = self;
        configuration
    }

    /// The configuration, if it is closed.
    pub fn closed(self) -> Option<Vec<f64>> {
        match self {
            Closed::Closed(configuration) => Some(configuration),
            Closed::Apart(_) => None,
        }
    }
}

/// The answers of [`Robot::close_batch`].
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedBatch {
    /// The configurations, one after another: closed, or with the smallest gaps.
    pub configurations: Vec<f64>,
    /// For each, whether it is closed.
    pub is_closed: Vec<bool>,
}

/// Kinematic loops: what `loops_module` says of them, how far a configuration is from closed, and the nearest closed one.
///
/// Link poses, distances and all other queries are of the spanning tree, for any configuration: ask for them in a closed
/// configuration. A robot without `loops_module` is a tree: it has no equations, every configuration is closed, and all DOFs
/// move freely.
///
/// ```
/// use urdd_robot::{CloseSettings, Closed, Robot};
///
/// # let folder = tempfile::tempdir()?;
/// # let urdf = folder.path().join("four_bar.urdf");
/// # let joint = |name: &str, parent: &str, child: &str, x: f64| format!(
/// #     r#"<joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/>
/// #     <origin xyz="{x} 0 0"/><axis xyz="0 0 1"/></joint>"#);
/// # std::fs::write(&urdf, format!(r#"<robot name="four_bar"><link name="ground"/><link name="crank_link"/>
/// #     <link name="coupler_link"/><link name="rocker_link"/>{}{}{}<loop name="pin" type="revolute">
/// #     <predecessor link="coupler_link"><origin xyz="0.35 0 0"/></predecessor>
/// #     <successor link="rocker_link"><origin xyz="0.25 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
/// #     joint("crank", "ground", "crank_link", 0.0), joint("coupler", "crank_link", "coupler_link", 0.12),
/// #     joint("rocker", "ground", "rocker_link", 0.4)))?;
/// # let path = folder.path().join("four_bar");
/// # urdd_generate::generate(&urdf, &path, &Default::default(), &())?;
/// let robot = Robot::open(&path)?;
/// let crank = robot.dof("crank")?;
///
/// // From a closed configuration, the crank turns by 0.1 rad, and the others follow.
/// let mut q = robot.reference_configuration()?;
/// q[crank] += 0.1;
/// match robot.close(&q, &CloseSettings { held: &[crank], ..Default::default() })? {
///     Closed::Closed(closed) => assert_eq!(closed[crank], q[crank]),
///     Closed::Apart(nearest) => println!("{:?}", robot.loop_errors(&nearest)?.gaps),
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Each method fails with [`RobotError::Configuration`] if the length of a configuration differs from the number of DOFs or
/// a value is not finite; and if `loops_module` is unusable, or another module that it needs is missing or unusable:
/// `chain_module` and `dof_module`, for loops also `bounds_module` and `urdf_module`.
impl Robot {
    /// What closes the loops of the robot. `None` without `loops_module`: the robot is a tree.
    pub fn loops(&self) -> Result<Option<&LoopsModule>, RobotError> {
        const LOOPS: ModuleKind = ModuleKind::Loops;
        keep(&self.loops, || {
            let Some(part) = self.optional(LOOPS)? else { return Ok(None) };
            match part.document(LOOPS) {
                Some(ModuleDocument::Loops(module)) => Ok(Some((**module).clone())),
                _ => Err(RobotError::Missing(LOOPS)),
            }
        })
        .map(Option::as_ref)
    }

    /// What is closed; `None` for a tree.
    pub(super) fn closure(&self) -> Result<Option<&Arc<Closure>>, RobotError> {
        keep(&self.closure, || {
            let said =
                |module: &&LoopsModule| !module.loops.is_empty() || !module.couplings.is_empty();
            let Some(module) = self.loops()?.filter(said) else { return Ok(None) };
            let part = self.moving_part(&[ModuleKind::Urdf])?;
            let closure =
                Closure::new(module, &part, &self.motion()?.kinematics, self.configurations()?)?;
            Ok(Some(Arc::new(closure)))
        })
        .map(Option::as_ref)
    }

    /// A configuration in which all loops are closed: that of `loops_module`, to begin with. For a tree, the default one,
    /// [`Configurations::zero`](crate::Configurations::zero).
    pub fn reference_configuration(&self) -> Result<Vec<f64>, RobotError> {
        match self.loops()? {
            Some(module) => Ok(module.reference_configuration.clone()),
            None => Ok(self.configurations()?.zero()),
        }
    }

    /// How far a configuration is from closed.
    pub fn loop_errors(&self, configuration: &[f64]) -> Result<LoopErrors, RobotError> {
        let mut errors = LoopErrors::default();
        self.loop_errors_into(configuration, &mut errors)?;
        Ok(errors)
    }

    /// As [`Robot::loop_errors`], into a reusable value. It does not allocate after the first of a thread.
    pub fn loop_errors_into(
        &self,
        configuration: &[f64],
        errors: &mut LoopErrors,
    ) -> Result<(), RobotError> {
        let LoopErrors { gaps, sums, is_closed } = errors;
        let kinematics = &self.motion()?.kinematics;
        let Some(closure) = self.closure()? else {
            ConfigurationError::check(configuration, kinematics.num_dofs())?;
            gaps.clear();
            sums.clear();
            *is_closed = true;
            return Ok(());
        };
        let loops = &closure.loops;
        with_workspace(|workspace| {
            let poses = &mut workspace.placed.poses;
            kinematics.link_poses_into(configuration, poses)?;
            gaps.clear();
            gaps.extend(loops.gaps(poses));
            sums.clear();
            sums.extend(loops.sums(configuration));
            *is_closed = loops.is_closed(configuration, poses);
            Ok(())
        })
    }

    /// Searches for a closed configuration near another one, within the bounds: by the method of Levenberg and Marquardt on
    /// the equations of all loops and couplings. Start near what is wanted, such as from the last configuration of a motion:
    /// the answer is on the branch of closed configurations that is near. It depends on nothing else. Values out of bounds
    /// are first moved to the nearest bound, those of DOFs that no loop depends on too.
    ///
    /// # Errors
    /// [`RobotError::OutOfRange`] for a held DOF that is out of range, and [`RobotError::Setting`] for bounds that are not
    /// one pair for each DOF, the lower first.
    pub fn close(
        &self,
        configuration: &[f64],
        settings: &CloseSettings,
    ) -> Result<Closed, RobotError> {
        let mut closed = configuration.to_vec();
        Ok(match self.close_into(&mut closed, settings)? {
            true => Closed::Closed(closed),
            false => Closed::Apart(closed),
        })
    }

    /// As [`Robot::close`], in place: true if `configuration` is now closed, false if it is the one with the smallest gaps.
    /// It does not allocate after the first of a thread. After an error, `configuration` is any.
    ///
    /// # Errors
    /// As there.
    pub fn close_into(
        &self,
        configuration: &mut [f64],
        settings: &CloseSettings,
    ) -> Result<bool, RobotError> {
        let kinematics = &self.motion()?.kinematics;
        let dofs = kinematics.num_dofs();
        ConfigurationError::check(configuration, dofs)?;
        settings.check(dofs)?;
        let closure = self.closure()?;
        let bounds = match settings.bounds {
            Some(bounds) => bounds,
            None => self.configurations()?.limits(),
        };
        with_closing_space(|ClosingSpace { scratch, held, .. }| {
            held.clear();
            held.resize(dofs, false);
            settings.held.iter().for_each(|dof| held[*dof] = true);
            for ((value, [lower, upper]), held) in configuration.iter_mut().zip(bounds).zip(&*held)
            {
                *value = if *held { *value } else { value.max(*lower).min(*upper) };
            }
            let Some(closure) = closure else { return Ok(true) };
            let is_held = |dof: usize| held[dof];
            match closure.loops.close(kinematics, configuration, bounds, is_held, scratch) {
                Ok(_) => Ok(true),
                Err(NotClosed::Unusable(error)) => Err(error.into()),
                Err(_) => Ok(false),
            }
        })
    }

    /// As [`Robot::close`], for a batch of configurations, stored one after another in `configurations`. Runs on rayon's
    /// thread pool; each answer depends on its configuration alone.
    ///
    /// # Errors
    /// As there, [`RobotError::Batch`] if the number of values is not a multiple of the number of DOFs, and
    /// [`RobotError::Memory`] if there is not enough memory.
    pub fn close_batch(
        &self,
        configurations: &[f64],
        settings: &CloseSettings,
    ) -> Result<ClosedBatch, RobotError> {
        let motion = self.motion()?;
        let count = motion.rows(configurations)?.count;
        let mut found = ClosedBatch {
            configurations: room(count, motion.kinematics.num_dofs())?,
            is_closed: room(count, 1)?,
        };
        found.configurations.copy_from_slice(configurations);
        let on = Cancellation::default();
        self.close_batch_into(&mut found.configurations, settings, &on, &mut found.is_closed)?;
        Ok(found)
    }

    /// As [`Robot::close_batch`], in place, with whether each is closed in `is_closed`. After an error, configurations are
    /// any.
    ///
    /// # Errors
    /// As there, [`RobotError::Room`] if the length of `is_closed` differs from the number of configurations, and
    /// [`RobotError::Cancelled`].
    pub fn close_batch_into(
        &self,
        configurations: &mut [f64],
        settings: &CloseSettings,
        cancellation: &Cancellation,
        is_closed: &mut [bool],
    ) -> Result<(), RobotError> {
        let motion = self.motion()?;
        check_room(is_closed.len(), motion.rows(configurations)?.count, 1)?;
        let dofs = motion.kinematics.num_dofs();
        settings.check(dofs)?;
        if dofs == 0 {
            is_closed.fill(self.close_into(configurations, settings)?);
            return Ok(());
        }
        let closed: Vec<AtomicBool> = is_closed.iter().map(|_| AtomicBool::default()).collect();
        fill(configurations, dofs, BLOCK, |(): &mut (), k, configuration| {
            cancellation.check()?;
            closed[k].store(self.close_into(configuration, settings)?, Ordering::Relaxed);
            Ok::<(), RobotError>(())
        })?;
        let closed = closed.into_iter().map(AtomicBool::into_inner);
        is_closed.iter_mut().zip(closed).for_each(|(out, closed)| *out = closed);
        Ok(())
    }
}

impl CloseSettings<'_> {
    fn check(&self, dofs: usize) -> Result<(), RobotError> {
        if let Some(index) = self.held.iter().copied().find(|dof| *dof >= dofs) {
            return Err(RobotError::OutOfRange { what: "DOF", index, count: dofs });
        }
        let Some(bounds) = self.bounds else { return Ok(()) };
        match bounds.len() == dofs && bounds.iter().all(|[lower, upper]| lower <= upper) {
            true => Ok(()),
            false => Err(RobotError::Setting("bounds are one pair for each DOF, the lower first")),
        }
    }
}
