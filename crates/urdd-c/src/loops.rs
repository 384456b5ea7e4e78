//! Kinematic loops: how far configurations are from closed, closed ones near them, and velocities that keep loops closed.

use urdd_directory::cancellation::Cancellation;
use urdd_robot::{CloseSettings, LoopErrors};

use crate::failure::{Failure, Status, Text, run};
use crate::memory::{at, exact_room, put, put_all, put_numbers, room, values};
use crate::names::nth;
use crate::robot::Robot;

/// Writes the number of loops, of couplings between DOFs, of equations of both together, and of DOFs that move freely. Each
/// of the four can be null. A robot without loops_module is a tree: it has no equations, every configuration is closed, and
/// all DOFs move freely.
///
/// Errors, as of all functions on loops: `MISSING_MODULE`, `UNUSABLE`: chain_module, dof_module, loops_module; for a robot
/// with loops also bounds_module and urdf_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_sizes(
    handle: *const Robot,
    loops: *mut usize,
    couplings: *mut usize,
    equations: *mut usize,
    independent: *mut usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let [known_loops, known_couplings] = robot.loop_names()?;
        put_numbers([
            ("loops", loops, known_loops.len()),
            ("couplings", couplings, known_couplings.len()),
            ("equations", equations, robot.robot.num_loop_equations()?),
            ("independent", independent, robot.robot.num_independent_dofs()?),
        ])
    })
}

/// Writes the name of a loop. It lives as long as the robot.
///
/// Errors: also `OUT_OF_RANGE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_name(
    handle: *const Robot,
    index: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe { put("out", out, nth("loop", &at(handle)?.loop_names()?[0], index)?.text()) })
}

/// As `urdd_robot_loop_name`, for a coupling.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_coupling_name(
    handle: *const Robot,
    index: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe {
        put("out", out, nth("coupling", &at(handle)?.loop_names()?[1], index)?.text())
    })
}

/// Writes a configuration in which all loops are closed, to begin with: that of loops_module; for a tree, the default one.
/// `dofs` values, rad or m.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_reference_configuration(
    handle: *const Robot,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.reference_configuration()?;
        put_all(("configuration", configuration, dofs), (1, known.len()), known)
    })
}

/// Writes how far each configuration is from closed.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m. `gaps` has room for `gaps_length` values, rows x loops x 2:
/// the position gap of each loop in metres, then its rotation gap in radians. `sums` has room for `sums_length` values,
/// rows x couplings: the sum of each coupling, which is 0 where it holds. `closed` has room for `rows` values: whether all
/// loops are closed and all couplings hold, within their tolerances.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_errors(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    gaps: *mut f64,
    gaps_length: usize,
    sums: *mut f64,
    sums_length: usize,
    closed: *mut bool,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let [loops, couplings] = robot.loop_names()?.each_ref().map(Vec::len);
        let gaps = q.room(("gaps", gaps, gaps_length), 2 * loops)?;
        let sums = q.room(("sums", sums, sums_length), couplings)?;
        let closed = q.room(("closed", closed, rows), 1)?;
        let mut errors = LoopErrors::default();
        for (k, closed) in closed.iter_mut().enumerate() {
            robot.robot.loop_errors_into(q.row(k), &mut errors)?;
            let known = errors.gaps.iter().flat_map(|gap| [gap.position, gap.rotation]);
            let out = &mut gaps[2 * loops * k..2 * loops * (k + 1)];
            out.iter_mut().zip(known).for_each(|(out, value)| *out = value);
            sums[couplings * k..couplings * (k + 1)].copy_from_slice(&errors.sums);
            *closed = errors.is_closed;
        }
        Ok(())
    })
}

/// Writes the closed configuration near each of some configurations, within the bounds.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `found` has room for rows x dofs values, `closed` for
/// `rows`. Start near what is wanted, such as from the last configuration of a motion: the result is on the branch of
/// closed configurations that is near. Where none is found, `closed` is false, and `found` has the smallest gaps: as a
/// rule, the loops cannot close with what is held and bounded. `held` has the indices of `held_length` DOFs that keep their
/// value; or null. `bounds` has `bounds_length` values, dofs x 2, a lower and an upper one for each DOF, which may be
/// infinite; or null, with 0, for those of bounds_module: a DOF that is not limited has none. Values out of bounds are
/// first moved to the nearest bound. One row is computed on this thread, without an allocation.
///
/// Errors: also `OUT_OF_RANGE` for a held DOF; `VALUE` for crossed bounds.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_close(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    held: *const usize,
    held_length: usize,
    bounds: *const f64,
    bounds_length: usize,
    found: *mut f64,
    closed: *mut bool,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let held = values("held", held, held_length)?;
        let expected = if bounds.is_null() { 0 } else { 2 * dofs };
        if bounds_length != expected {
            let message = format!("`bounds` has {bounds_length} values: expected {expected}");
            return Err(Failure::new(Status::Length, message));
        }
        let known = values("bounds", bounds, bounds_length)?.as_chunks().0;
        let settings = CloseSettings { held, bounds: (!bounds.is_null()).then_some(known) };
        let found = q.room(("found", found, rows.saturating_mul(dofs)), dofs)?;
        let closed = q.room(("closed", closed, rows), 1)?;
        found.copy_from_slice(q.values);
        if let [closed] = closed {
            *closed = robot.robot.close_into(found, &settings)?;
            return Ok(());
        }
        let on = Cancellation::default();
        Ok(robot.robot.close_batch_into(found, &settings, &on, closed)?)
    })
}

/// Writes the indices of the DOFs that move freely, ascending, as loops_module states them; the others follow from them
/// near its reference configuration. `out` has room for `length` indices: as many as `urdd_robot_loop_sizes` says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_independent_dofs(
    handle: *const Robot,
    out: *mut usize,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.independent_dofs()?;
        put_all(("out", out, length), (1, known.len()), known)
    })
}

/// Writes for each DOF whether it moves freely in a closed configuration: as `urdd_robot_independent_dofs`, as far as the
/// others follow from these there. `configuration` has `dofs` values, rad or m; `free` has room for as many.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_free_dofs(
    handle: *const Robot,
    configuration: *const f64,
    dofs: usize,
    free: *mut bool,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configuration", configuration, (1, dofs))?;
        let out = room("free", free, dofs)?;
        for dof in robot.robot.free_dofs(q.values)?.independent {
            out[dof] = true;
        }
        Ok(())
    })
}

/// Writes the left-hand side of each equation, which is 0 where it holds: for each loop those of its kind, then the sum of
/// each coupling. With the pose of frame B in frame A, of position p and rotation R, a loop has the components of p that it
/// holds, m; then the rotation vector of R if it holds the rotation, the x and y components of R ez if it holds the
/// direction of z, or the z component of R ez if it holds the right angle.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `residuals` has room for `length` values: rows x equations.
/// One row is computed on this thread, without an allocation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_residuals(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    residuals: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let width = robot.robot.num_loop_equations()?;
        q.answer(("residuals", residuals, length), width, |q, out| {
            robot.robot.loop_residuals_into(q, out)
        })
    })
}

/// Writes the derivatives of the equations of `urdd_robot_loop_residuals` by each DOF. Velocities keep the loops closed
/// where this matrix times them is 0. The rows of a rotation that a loop holds are the angular velocity of frame B relative
/// to frame A, in the axes of frame A. Rows that say the same as others are normal.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `jacobians` has room for `length` values: rows x dofs x
/// equations, the values of each column together (column-major). One row is computed on this thread, without an allocation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_jacobians(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    jacobians: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let width = dofs.saturating_mul(robot.robot.num_loop_equations()?);
        q.answer(("jacobians", jacobians, length), width, |q, out| {
            robot.robot.loop_jacobian_into(q, out)
        })
    })
}

/// Writes the velocities of all DOFs that keep the loops closed, rad/s or m/s, for those of the independent DOFs.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `independent` has `length` values, rows x independent, in
/// the order of `urdd_robot_independent_dofs`; `velocities` has room for rows x dofs values. NaN where the others do not
/// follow from these: at a dead point, or where parts are in a line. One row is computed on this thread, without an
/// allocation.
///
/// Errors: also `VALUE` for a velocity that is not finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_loop_velocities(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    independent: *const f64,
    length: usize,
    velocities: *mut f64,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let width = robot.robot.num_independent_dofs()?;
        if rows.checked_mul(width) != Some(length) {
            let message = format!("`independent` has {length} values: expected {rows} x {width}");
            return Err(Failure::new(Status::Length, message));
        }
        let given = values("independent", independent, length)?;
        let all = rows.saturating_mul(dofs);
        let out = exact_room("velocities", velocities, all, (rows, dofs))?;
        for k in 0..rows {
            let out = &mut out[k * dofs..(k + 1) * dofs];
            let given = &given[k * width..(k + 1) * width];
            if !robot.robot.loop_velocities_into(q.row(k), given, out)? {
                out.fill(f64::NAN);
            }
        }
        Ok(())
    })
}
