//! What a robot has beside its parts: pairs of shapes that need no collision check (MoveIt's allowed collision matrix, for shapes);
//! and its configurations: bounds, named places in them, samples.

use std::ffi::c_char;

use crate::failure::{Failure, Status, run};
use crate::memory::{at, exact_room, free, handle, make, plain, put, put_all, read_text, room};
use crate::names::out_of_range;
use crate::proximity::shape_kind;
use crate::robot::Robot;
use urdd_robot::{Configurations, RobotError, fill};

/// The skips between the shapes of one kind.
pub struct Skips(urdd_robot::Skips);

handle!(Skips, "urdd_skips");

/// A shape: the index of its link, and of the link's piece; 0 for hulls and their bounding volumes.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// The index of the link.
    pub link: usize,
    /// The index of the piece.
    pub piece: usize,
}

plain!(Place);

/// Reads the skips between the shapes of a kind. `kind` is as for `urdd_robot_proximity`.
///
/// Errors: `UNKNOWN_NAME` for the kind; `MISSING_MODULE`, `UNUSABLE`: the skips modules.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_skips(
    handle: *const Robot,
    kind: *const c_char,
    out: *mut *mut Skips,
) -> Status {
    unsafe {
        make(out, || {
            let kind = shape_kind(read_text("kind", kind)?)?;
            Ok(Skips(at(handle)?.robot.skips(kind)?))
        })
    }
}

/// Frees skips. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_free(skips: *mut Skips) -> Status {
    unsafe { free(skips) }
}

/// Writes the number of shapes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_len(handle: *const Skips, out: *mut usize) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.0.len()) })
}

/// Writes the link and the piece of each shape.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_places(
    handle: *const Skips,
    places: *mut Place,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.0.places();
        let each = known.iter().map(|(link, piece)| Place { link: *link, piece: *piece });
        put_all(("places", places, length), (known.len(), 1), each)
    })
}

/// Writes whether a pair of shapes is skipped, by their indices. A shape with itself is.
///
/// Errors: `OUT_OF_RANGE`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_skips_is_skipped(
    handle: *const Skips,
    i: usize,
    j: usize,
    out: *mut bool,
) -> Status {
    run(|| unsafe {
        let skips = &at(handle)?.0;
        for index in [i, j] {
            if index >= skips.len() {
                return Err::<(), Failure>(out_of_range("shape", index, skips.len()));
            }
        }
        put("out", out, skips.is_skipped(i, j))
    })
}

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
