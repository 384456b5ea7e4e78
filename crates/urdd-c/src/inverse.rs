//! Inverse kinematics.

use std::ptr;

use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose_matrix::pose;
use urdd_robot::{InverseSettings, RobotError, Target as RobotTarget, fill};

use crate::failure::{Failure, Status, run};
use crate::handle::at;
use crate::memory::{Plain, check, exact_room, put, values};
use crate::proximity::Proximity;
use crate::robot::Robot;

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

/// Tolerances and limits of inverse kinematics. `urdd_inverse_settings_default` sets them.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Position tolerance, metres.
    pub position_tolerance: f64,
    /// Rotation tolerance, radians.
    pub rotation_tolerance: f64,
    /// Maximum number of iterations per descent.
    pub iterations: usize,
    /// Maximum number of descents from random configurations after the first one.
    pub restarts: usize,
    /// Seed of the random configurations. The search is deterministic.
    pub seed: u64,
    /// Bounds in place of those of bounds_module, rad or m: a lower and an upper value for each DOF; or null.
    pub bounds: *const f64,
    /// Number of values at `bounds`: dofs x 2, or 0.
    pub bounds_length: usize,
    /// Indices of DOFs that keep the value that they have in the start; or null.
    pub locked: *const usize,
    /// Number of indices at `locked`.
    pub locked_length: usize,
    /// A configuration that the solution should be near, rad or m: every descent is used, and the nearest solution counts;
    /// or null.
    pub posture: *const f64,
    /// Number of values at `posture`: dofs, or 0.
    pub posture_length: usize,
    /// Shapes that must not touch one another in a solution, which is searched until one is free; or null.
    pub free_of: *const Proximity,
    /// Whether to find out why a target is not reached, which takes as long as the search.
    pub explain: bool,
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
    /// Every configuration that was found to reach it was refused by `free_of`.
    Refused = 2,
    /// None within the bounds was found, but one beyond them.
    Limits = 3,
    /// None was found, within the bounds or beyond them.
    OutOfReach = 4,
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
            Of::Unknown => Verdict::Unknown,
        }
    }
}

// SAFETY: zeros are numbers, false, and `Unknown`.
unsafe impl Plain for Solution {}
// SAFETY: as above.
unsafe impl Plain for Target {}

/// Writes the default settings: tolerances of 1e-6, 100 iterations, 100 restarts, seed 0, no bounds, nothing
/// locked, no posture, no shapes, no explanation.
///
/// # Safety
/// `out` is null or has room for settings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_inverse_settings_default(out: *mut Settings) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let settings = InverseSettings::default();
        put(
            "out",
            out,
            Settings {
                position_tolerance: settings.position_tolerance,
                rotation_tolerance: settings.rotation_tolerance,
                iterations: settings.iterations,
                restarts: settings.restarts,
                seed: settings.seed,
                bounds: ptr::null(),
                bounds_length: 0,
                locked: ptr::null(),
                locked_length: 0,
                posture: ptr::null(),
                posture_length: 0,
                free_of: ptr::null(),
                explain: false,
            },
        )
    })
}

/// The settings, and the shapes that a solution must be free of.
///
/// # Safety
/// `settings` is null or one that can be read, with its arrays and handle.
unsafe fn settings<'a>(
    settings: *const Settings,
) -> Result<(InverseSettings, Option<&'a Proximity>), Failure> {
    if settings.is_null() {
        let explain = false;
        let settings = InverseSettings { explain, ..InverseSettings::default() };
        return Ok((settings, None));
    }
    check("settings", settings)?;
    // SAFETY: guaranteed by the caller.
    unsafe {
        let settings = settings.read();
        let bounds = values("bounds", settings.bounds, settings.bounds_length)?;
        let (pairs, rest) = bounds.as_chunks::<2>();
        if !rest.is_empty() {
            let message = format!("`bounds` has {} values: expected two a DOF", bounds.len());
            return Err(Failure::new(Status::Length, message));
        }
        let locked = values("locked", settings.locked, settings.locked_length)?;
        let posture = values("posture", settings.posture, settings.posture_length)?;
        let free_of = match settings.free_of.is_null() {
            true => None,
            false => Some(at(settings.free_of)?),
        };
        let settings = InverseSettings {
            position_tolerance: settings.position_tolerance,
            rotation_tolerance: settings.rotation_tolerance,
            iterations: settings.iterations,
            restarts: settings.restarts,
            seed: settings.seed,
            bounds: (!pairs.is_empty()).then(|| pairs.to_vec()),
            locked: locked.to_vec(),
            posture: (!posture.is_empty()).then(|| posture.to_vec()),
            explain: settings.explain,
        };
        Ok((settings, free_of))
    }
}

/// Searches, for each target, a configuration within the bounds that reaches it: by damped least squares from its
/// start, then from random configurations. Checks for collisions where `free_of` is set.
///
/// There are `count` targets. `starts` has `starts_rows` rows of `dofs` values, rad or m: one for all targets or one for
/// each. `settings` may be null. `configurations` has room for count x dofs values, `solutions` for `count`. Where a
/// target is not reached, the nearest configuration is written, and its solution says so.
///
/// Errors: `OUT_OF_RANGE` for a link; `LENGTH`; `VALUE` for NaN or infinity, or a matrix that is not a rotation and a
/// translation; `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module or bounds_module.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
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
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let robot = at(handle)?;
        let targets = targets_of(targets, count)?;
        let q = robot.rows("starts", starts, (starts_rows, dofs))?;
        if starts_rows != 1 && starts_rows != count {
            let message = format!("`starts` has {starts_rows} rows: expected 1 or {count}");
            return Err(Failure::new(Status::Length, message));
        }
        let (settings, free_of) = self::settings(settings)?;
        if let Some(shapes) = free_of
            && shapes.0.num_dofs() != dofs
        {
            let message = format!(
                "`free_of` is of a robot with {} DOFs: expected {dofs}",
                shapes.0.num_dofs()
            );
            return Err(Failure::new(Status::Length, message));
        }
        let is_free =
            |q: &[f64]| free_of.is_none_or(|shapes| shapes.0.in_collision(q) == Ok(false));
        let length = count.saturating_mul(dofs);
        let inputs = [q.values];
        let out = exact_room("configurations", configurations, length, (count, dofs), &inputs)?;
        let found = exact_room("solutions", solutions, count, (count, 1), &inputs)?;
        let on = Cancellation::default();
        let mut all: Vec<(Vec<f64>, Solution)> = vec![Default::default(); count];
        fill(
            &mut all,
            1,
            1,
            || (),
            |(), k, out| {
                let start = q.row(if starts_rows == 1 { 0 } else { k });
                let target = &targets[k];
                let inverse = robot
                    .robot
                    .inverse_kinematics_where(target, start, &settings, &is_free, &on)?;
                let nearest = inverse.nearest();
                let solution = Solution {
                    position_error: nearest.position_error,
                    rotation_error: nearest.rotation_error,
                    restarts: nearest.restarts,
                    iterations: nearest.iterations,
                    is_reached: inverse.is_reached(),
                    verdict: nearest.verdict.into(),
                };
                out[0] = (nearest.configuration.clone(), solution);
                Ok::<(), RobotError>(())
            },
        )?;
        for (k, (configuration, solution)) in all.into_iter().enumerate() {
            out[k * dofs..(k + 1) * dofs].copy_from_slice(&configuration);
            found[k] = solution;
        }
        Ok(())
    })
}

/// # Safety
/// There are `count` targets at `targets`.
unsafe fn targets_of(targets: *const Target, count: usize) -> Result<Vec<RobotTarget>, Failure> {
    // SAFETY: guaranteed by the caller.
    let targets = unsafe { values("targets", targets, count) }?;
    let target = |(k, target): (usize, &Target)| {
        let [_, _, _, x, _, _, _, y, _, _, _, z, ..] = target.pose;
        let made = match target.is_position {
            true => RobotTarget::position(target.link, [x, y, z]),
            false => {
                let pose = pose(&target.pose).ok_or_else(|| {
                    let message =
                        format!("the pose of target {k} is not a rotation and a translation");
                    Failure::new(Status::Value, message)
                })?;
                RobotTarget::pose(target.link, pose)
            }
        };
        let made = match target.weights == [0.0; 6] {
            true => made,
            false => made.weighted(target.weights),
        };
        Ok(made.of_point(target.point))
    };
    targets.iter().enumerate().map(target).collect()
}
