//! Inverse kinematics.

use std::mem;
use urdd_format::readable::counted;

use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose::pose;
use urdd_robot::{InverseSettings, Queries, RobotError, Target as RobotTarget, check_margin, fill};

use crate::failure::{Failure, Status, run};
use crate::memory::{Handle, at, check, exact_room, plain, put, values};
use crate::proximity::Proximity;
use crate::robot::Robot;
use crate::world::WorldProximity;

/// A target of inverse kinematics, in the root link's frame.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// The index of the link.
    pub link: usize,
    /// The pose: a homogeneous 4 x 4 matrix in row-major order, metres. Its rotation is that of the link's frame, its
    /// translation where `point` should be.
    pub pose: [f64; 16],
    /// A point of the link, such as a tool tip, in the link's frame, metres.
    pub point: [f64; 3],
    /// True if only the position counts: the link's rotation is free.
    pub is_position: bool,
    /// Weights of the translation along, and of the rotation about, the x, y and z axes of `pose`, 0 or more: 0 leaves
    /// one free, as (0, 0, 0, 1, 1, 1) for a rotation alone. Six zeros stand for six ones.
    pub weights: [f64; 6],
}

/// Tolerances and limits of inverse kinematics. Begin with `urdd_inverse_settings_default`: settings full of zeros are
/// refused, as they allow no iteration.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Position tolerance, metres; 0 or more.
    pub position_tolerance: f64,
    /// Rotation tolerance, radians; 0 or more.
    pub rotation_tolerance: f64,
    /// Maximum number of iterations per descent; at least 1.
    pub iterations: usize,
    /// Maximum number of descents from random configurations after the first one.
    pub restarts: usize,
    /// Seed of the random configurations. The search is deterministic.
    pub seed: u64,
    /// Bounds in place of those of bounds_module, rad or m: a lower and an upper value for each DOF, limited or not; or
    /// null.
    pub bounds: *const f64,
    /// Number of values at `bounds`: dofs x 2; 0 for null.
    pub bounds_length: usize,
    /// Indices of DOFs that keep the value that they have in the start; or null.
    pub locked: *const usize,
    /// Number of indices at `locked`.
    pub locked_length: usize,
    /// A configuration that the solution should be near, rad or m; or null. Restarts go on until several in a row bring
    /// no nearer solution, and the nearest counts.
    pub posture: *const f64,
    /// Number of values at `posture`: dofs; 0 for null.
    pub posture_length: usize,
    /// Shapes that must not touch one another in a solution, which is searched until one is free; or null.
    pub free_of: *const Proximity,
    /// A robot among obstacles that it must not touch in a solution; or null.
    pub free_of_world: *const WorldProximity,
    /// The distance that a solution keeps from the obstacles of `free_of_world`, metres; 0 or more.
    pub margin: f64,
    /// Whether to find out why a target is not reached, which takes as long as the search.
    pub explain: bool,
    /// Whether the kinematic loops of the robot may be open in a solution. False in the settings of
    /// `urdd_inverse_settings_default`; without meaning for a tree.
    pub open_loops: bool,
}

/// Whether a target is reached; if not, why.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Verdict {
    /// None within the bounds was found; why was not searched for.
    #[default]
    Unknown = 0,
    /// It is reached within the tolerances.
    Reached = 1,
    /// Every configuration that was found to reach it was refused by `free_of` or `free_of_world`.
    Refused = 2,
    /// None within the bounds was found, but one beyond them.
    Limits = 3,
    /// None was found, within the bounds or beyond them.
    OutOfReach = 4,
    /// None was found that is closed, but one within the bounds with open loops.
    Loops = 5,
}

/// How near a configuration comes to its target.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default)]
pub struct Solution {
    /// Distance of the point from the target, metres.
    pub position_error: f64,
    /// Angle between the link's rotation and the target, radians; 0 for a position.
    pub rotation_error: f64,
    /// Number of descents from random configurations.
    pub restarts: usize,
    /// Number of iterations of all descents.
    pub iterations: usize,
    /// True if the target is reached within the tolerances.
    pub is_reached: bool,
    /// Whether it is, or why not.
    pub verdict: Verdict,
}

impl From<urdd_robot::Verdict> for Verdict {
    fn from(verdict: urdd_robot::Verdict) -> Self {
        use urdd_robot::Verdict as Of;
        match verdict {
            Of::Reached => Verdict::Reached,
            Of::Refused => Verdict::Refused,
            Of::Limits => Verdict::Limits,
            Of::OutOfReach => Verdict::OutOfReach,
            Of::Loops => Verdict::Loops,
            Of::Unknown => Verdict::Unknown,
        }
    }
}

// The verdict 0 is `Unknown`.
plain!(Solution, Target);

/// Writes the default settings: tolerances of 1e-6, 100 iterations, 100 restarts, seed 0, no bounds, nothing
/// locked, no posture, no shapes, no obstacles, no margin, no explanation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_inverse_settings_default(out: *mut Settings) -> Status {
    let of = InverseSettings::default();
    run(|| unsafe {
        let settings = Settings {
            position_tolerance: of.position_tolerance,
            rotation_tolerance: of.rotation_tolerance,
            iterations: of.iterations,
            restarts: of.restarts,
            seed: of.seed,
            // Null pointers, 0 and false.
            ..mem::zeroed()
        };
        put("out", out, settings)
    })
}

/// What a solution must be free of.
#[derive(Clone, Copy, Default)]
struct FreeOf<'a> {
    itself: Option<&'a Proximity>,
    world: Option<&'a WorldProximity>,
    margin: f64,
}

impl FreeOf<'_> {
    fn is_free(self, q: &[f64]) -> bool {
        self.itself.is_none_or(|shapes| shapes.0.in_collision(q) == Ok(false))
            && self.world.is_none_or(|world| world.0.is_within(q, self.margin) == Ok(false))
    }

    /// Whether the shapes are those of a robot with as many DOFs, and the margin is one.
    fn check(self, dofs: usize) -> Result<(), Failure> {
        let itself = self.itself.map(|shapes| ("free_of", shapes.0.num_dofs()));
        let world = self.world.map(|world| ("free_of_world", world.0.num_dofs()));
        let other = itself.into_iter().chain(world).find(|(_, found)| *found != dofs);
        if let Some((what, found)) = other {
            let found = counted(found, "DOF");
            let message = format!("`{what}` is of a robot with {found}: expected {dofs}");
            return Err(Failure::new(Status::Length, message));
        }
        Ok(check_margin(self.margin).map(drop)?)
    }
}

/// The settings, and what a solution must be free of.
unsafe fn settings<'a>(
    settings: *const Settings,
    dofs: usize,
) -> Result<(InverseSettings, FreeOf<'a>), Failure> {
    if settings.is_null() {
        let explain = false;
        let settings = InverseSettings { explain, ..InverseSettings::default() };
        return Ok((settings, FreeOf::default()));
    }
    check("settings", settings)?;
    unsafe {
        let settings = settings.read();
        let array = |what, data: *const f64, length, expected| {
            let expected = if data.is_null() { 0 } else { expected };
            if length != expected {
                let message = format!("`{what}_length` is {length}: expected {expected}");
                return Err(Failure::new(Status::Length, message));
            }
            Ok((!data.is_null()).then_some(values(what, data, length)?))
        };
        let bounds = array("bounds", settings.bounds, settings.bounds_length, 2 * dofs)?;
        let posture = array("posture", settings.posture, settings.posture_length, dofs)?;
        let locked = values("locked", settings.locked, settings.locked_length)?;
        if locked.len() > dofs {
            let (length, dofs) = (locked.len(), counted(dofs, "DOF"));
            let message = format!("`locked_length` is {length}: the robot has {dofs}");
            return Err(Failure::new(Status::Length, message));
        }
        let free_of = FreeOf {
            itself: optional(settings.free_of)?,
            world: optional(settings.free_of_world)?,
            margin: settings.margin,
        };
        free_of.check(dofs)?;
        let settings = InverseSettings {
            position_tolerance: settings.position_tolerance,
            rotation_tolerance: settings.rotation_tolerance,
            iterations: settings.iterations,
            restarts: settings.restarts,
            seed: settings.seed,
            bounds: bounds.map(|bounds| bounds.as_chunks().0.to_vec()),
            locked: locked.to_vec(),
            posture: posture.map(<[f64]>::to_vec),
            explain: settings.explain,
            open_loops: settings.open_loops,
        };
        Ok((settings, free_of))
    }
}

/// A handle, unless it is null.
unsafe fn optional<'a, T: Handle>(handle: *const T) -> Result<Option<&'a T>, Failure> {
    (!handle.is_null()).then(|| unsafe { at(handle) }).transpose()
}

/// Searches, for each target, a configuration within the bounds that reaches it: by damped least squares from its
/// start, then from random configurations. Checks for collisions where `free_of` or `free_of_world` is set.
///
/// Without `bounds`, a DOF that is not limited may also move as far from its start as its bounds are from 0: an angle
/// half a turn either way, so that a joint that follows a path does not jump by a turn. Of values a whole turn apart
/// that are within the bounds, the nearest to the posture, or to the start, is written.
///
/// There are `count` targets. `starts` has `starts_rows` rows of `dofs` values, rad or m: one for all targets or one
/// for each. `settings` may be null. `configurations` has room for count x dofs values, `solutions` for `count`. Where
/// a target is not reached, the nearest configuration is written, and its solution says so.
///
/// Errors: `OUT_OF_RANGE` for a link or a locked DOF; `LENGTH`, also for a posture or bounds without their length;
/// `VALUE` for NaN or infinity, a matrix that is not a rotation and a translation, a tolerance, weight or margin below
/// 0, weights that leave nothing to reach, crossed bounds, or 0 iterations; `POINTER` also if an output overlaps
/// anything else that is given; `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module or bounds_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_inverse_kinematics(
    handle: *const Robot,
    targets: *const Target,
    count: usize,
    starts: *const f64,
    starts_rows: usize,
    dofs: usize,
    settings: *const Settings,
    configurations: *mut f64,
    solutions: *mut Solution,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let targets = values("targets", targets, count)?;
        let q = robot.rows("starts", starts, (starts_rows, dofs))?;
        if starts_rows != 1 && starts_rows != count {
            let message = format!("`starts` has {starts_rows} rows: expected 1 or {count}");
            return Err(Failure::new(Status::Length, message));
        }
        let (settings, free_of) = self::settings(settings, dofs)?;
        let length = count.saturating_mul(dofs);
        for (k, target) in targets.iter().enumerate() {
            target_of(k, target)?;
        }
        let mut out = exact_room("configurations", configurations, length, (count, dofs))?;
        let found = exact_room("solutions", solutions, count, (count, 1))?;
        let on = Cancellation::default();
        let mut outputs: Vec<(&mut [f64], &mut Solution)> = Vec::new();
        let memory = |_| RobotError::Memory { count, width: dofs };
        outputs.try_reserve_exact(count).map_err(memory)?;
        for solution in found {
            let (row, rest) = mem::take(&mut out).split_at_mut(dofs);
            out = rest;
            outputs.push((row, solution));
        }
        let solve = |(): &mut (), k: usize, out: &mut [(&mut [f64], &mut Solution)]| {
            let start = q.row(if starts_rows == 1 { 0 } else { k });
            let target = target_of(k, &targets[k])?;
            let accepts = |q: &[f64]| free_of.is_free(q);
            let robot = &robot.robot;
            let inverse =
                robot.inverse_kinematics_where(&target, start, &settings, &accepts, &on)?;
            for (row, solution) in out {
                let nearest = inverse.nearest();
                row.copy_from_slice(&nearest.configuration);
                **solution = Solution {
                    position_error: nearest.position_error,
                    rotation_error: nearest.rotation_error,
                    restarts: nearest.restarts,
                    iterations: nearest.iterations,
                    is_reached: inverse.is_reached(),
                    verdict: nearest.verdict.into(),
                };
            }
            Ok(())
        };
        fill(&mut outputs, 1, 1, solve)
    })
}

/// Target number `k`.
fn target_of(k: usize, target: &Target) -> Result<RobotTarget, Failure> {
    let [_, _, _, x, _, _, _, y, _, _, _, z, ..] = target.pose;
    let made = match (target.is_position, pose(&target.pose)) {
        (true, _) => RobotTarget::position(target.link, [x, y, z]),
        (false, Some(pose)) => RobotTarget::pose(target.link, pose),
        (false, None) => {
            let message = format!("the pose of target {k} is not a rotation and a translation");
            return Err(Failure::new(Status::Value, message));
        }
    };
    let made = match target.weights == [0.0; 6] {
        true => made,
        false => made.weighted(target.weights),
    };
    Ok(made.of_point(target.point))
}
