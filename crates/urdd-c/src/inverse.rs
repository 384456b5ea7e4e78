//! Inverse kinematics.

use std::ptr;

use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose_matrix::pose;
use urdd_robot::{InverseSettings, RobotError, Target as RobotTarget, fill};

use crate::failure::{Failure, Status, run};
use crate::handle::at;
use crate::memory::{Plain, check, exact_room, put, values};
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
}

// SAFETY: zeros are numbers, and false.
unsafe impl Plain for Solution {}
// SAFETY: as above.
unsafe impl Plain for Target {}

/// Writes the default settings: tolerances of 1e-6, 100 iterations, 100 restarts, seed 0, no bounds.
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
            },
        )
    })
}

/// # Safety
/// `settings` is null or one that can be read, with its bounds.
unsafe fn settings(settings: *const Settings) -> Result<InverseSettings, Failure> {
    if settings.is_null() {
        return Ok(InverseSettings::default());
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
        Ok(InverseSettings {
            position_tolerance: settings.position_tolerance,
            rotation_tolerance: settings.rotation_tolerance,
            iterations: settings.iterations,
            restarts: settings.restarts,
            seed: settings.seed,
            bounds: (!pairs.is_empty()).then(|| pairs.to_vec()),
            explain: false,
            ..InverseSettings::default()
        })
    }
}

/// Searches, for each target, a configuration within the bounds that reaches it: by damped least squares from its
/// start, then from random configurations. Does not check for collisions.
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
        let settings = self::settings(settings)?;
        let length = count.saturating_mul(dofs);
        let inputs = [q.values];
        let out = exact_room(
            "configurations",
            configurations,
            length,
            (count, dofs),
            &inputs,
        )?;
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
                    .inverse_kinematics_cancellable(target, start, &settings, &on)?;
                let nearest = inverse.nearest();
                let solution = Solution {
                    position_error: nearest.position_error,
                    rotation_error: nearest.rotation_error,
                    restarts: nearest.restarts,
                    iterations: nearest.iterations,
                    is_reached: inverse.is_reached(),
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
        Ok(made.of_point(target.point))
    };
    targets.iter().enumerate().map(target).collect()
}
