//! Configurations: bounds, named places in them, samples.

use urdd_robot::{Configurations, RobotError, fill};

use crate::failure::{Status, run};
use crate::handle::at;
use crate::memory::{exact_room, put_all, room};
use crate::robot::Robot;

/// Configurations in one block of work.
const BLOCK: usize = 64;

/// Writes the lower and the upper bound of each DOF, rad or m: dofs x 2 values. Those of a rotation vector include all
/// rotations. Those of other DOFs that are not limited are a range to sample from, [-pi, pi] or [-1, 1], which the DOF
/// may leave: `urdd_robot_dof_is_limited` says which.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module or bounds_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_bounds(
    handle: *const Robot,
    bounds: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.configurations()?.bounds();
        let each = known.as_flattened().iter().copied();
        put_all(("bounds", bounds, length), (known.len(), 2), each)
    })
}

/// Writes for each DOF whether the source limits it: false for continuous, planar, floating and spherical joints.
/// `limited` has room for `dofs` values.
///
/// Errors: as `urdd_robot_bounds`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof_is_limited(
    handle: *const Robot,
    limited: *mut bool,
    dofs: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.configurations()?.dof_is_limited();
        put_all(("limited", limited, dofs), (1, known.len()), known.iter().copied())
    })
}

unsafe fn one(
    handle: *const Robot,
    configuration: *mut f64,
    dofs: usize,
    of: impl FnOnce(&Configurations) -> Vec<f64>,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.configurations()?;
        put_all(("configuration", configuration, dofs), (1, known.num_dofs()), of(known))
    })
}

/// Writes the default configuration (SPEC 9.4): every DOF at 0, or at the bound nearest to 0. `dofs` values, rad or m.
///
/// Errors: as `urdd_robot_bounds`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_zero(
    handle: *const Robot,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    unsafe { one(handle, configuration, dofs, Configurations::zero) }
}

/// As `urdd_robot_zero`, for the configuration with every DOF half-way between its bounds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_middle(
    handle: *const Robot,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    unsafe { one(handle, configuration, dofs, Configurations::middle) }
}

/// Writes `rows` samples of the sequence that SPEC 9.3 defines, from number `first` on: uniform within the bounds, and
/// the same in every implementation. rows x dofs values, rad or m.
///
/// Errors: as `urdd_robot_bounds`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_random(
    handle: *const Robot,
    first: u64,
    configurations: *mut f64,
    rows: usize,
    dofs: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.configurations()?;
        let shape = (rows, known.num_dofs());
        let length = rows.saturating_mul(dofs);
        let out = exact_room("configurations", configurations, length, shape)?;
        Ok(fill(out, dofs, BLOCK, |(): &mut (), k, out: &mut [f64]| {
            out.copy_from_slice(&known.random(first.wrapping_add(k as u64)));
            Ok::<(), RobotError>(())
        })?)
    })
}

/// Moves each of the `dofs` values of a configuration that is beyond its bounds to the nearer bound. Leaves rotation
/// vectors as they are.
///
/// Errors: as `urdd_robot_bounds`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_clamp(
    handle: *const Robot,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let known = robot.robot.configurations()?;
        let mut values = robot.rows("configuration", configuration, (1, dofs))?.values.to_vec();
        known.clamp(&mut values);
        room("configuration", configuration, dofs)?.copy_from_slice(&values);
        Ok(())
    })
}
