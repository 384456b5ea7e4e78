//! What planners ask beside distances: margins, motions, gradients, objects that links carry.

use std::sync::Arc;

use urdd_robot::{EdgeSettings, RobotError, Workspace};

use crate::failure::{Failure, Status, run};
use crate::handle::{at, make};
use crate::memory::{Plain, put, values};
use crate::obstacle::{Obstacle, placed};
use crate::proximity::{PairDistance, Proximity};
use crate::rows::Rows;
use crate::workspace::with_workspace;
use crate::world::{ObstacleDistance, WorldProximity};

/// Two shapes that touch or overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Overlap {
    /// The two shapes. Their distance is 0; the points are those that touch once the second shape has moved, before it
    /// moves.
    pub pair: PairDistance,
    /// The length of the least translation that separates the two, metres; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the second shape would move.
    pub direction: [f64; 3],
}

// SAFETY: zeros are numbers.
unsafe impl Plain for Overlap {}

/// Writes whether any pair is at most `margin` apart, metres, for each configuration. With a margin above 0, pairs count
/// whose links can move against each other.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `within` has room for `rows` values. One row is computed
/// on this thread, without an allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity, or a margin below 0.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_is_within(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    within: *mut bool,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let expected = proximity.num_dofs();
        let q = Rows::new("configurations", configurations, (rows, dofs), expected)?;
        q.answer(("within", within, rows), 1, |q, out| {
            out[0] = with_workspace(|memory| proximity.is_within_with(q, margin, memory))?;
            Ok(())
        })
    })
}

/// As `urdd_proximity_is_within`, for the pairs of a shape of the robot and an obstacle.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_is_within(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    within: *mut bool,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        q.answer(("within", within, rows), 1, |q, out| {
            out[0] = with_workspace(|memory| world.queries.is_within_with(q, margin, memory))?;
            Ok(())
        })
    })
}

/// Writes where each straight motion is blocked by the robot itself, as a part of it from 0 to 1; NaN where it is free.
///
/// `starts` and `ends` have `rows` rows of `dofs` values each, rad or m; `blocked` has room for `rows` values. `margin`
/// is the distance that must be kept, metres. With a `resolution` above 0, metres, configurations are checked between
/// which no point of the robot travels farther, the halves first. With 0, the motion is proved free by conservative
/// advancement; it then needs 0.1 mm more than the margin, and the answer is the first part where it has less.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity, a margin or a resolution below 0, or a motion that needs more than a
/// million configurations.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_blocked_edge(
    handle: *const Proximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    blocked: *mut f64,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let shape = (rows, dofs, proximity.num_dofs());
        edges([starts, ends], shape, blocked, |start, end, memory| {
            proximity.blocked_edge_with(start, end, &settings(margin, resolution), memory)
        })
    })
}

/// As `urdd_proximity_blocked_edge`, for motions that obstacles block.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_blocked_edge(
    handle: *const WorldProximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    blocked: *mut f64,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let shape = (rows, dofs, world.dofs);
        edges([starts, ends], shape, blocked, |start, end, memory| {
            let settings = settings(margin, resolution);
            world.queries.blocked_edge_with(start, end, &settings, memory)
        })
    })
}

fn settings(margin: f64, resolution: f64) -> EdgeSettings {
    let resolution = (resolution != 0.0).then_some(resolution);
    EdgeSettings { margin, resolution }
}

/// # Safety
/// As for [`Rows::new`].
unsafe fn edges(
    [starts, ends]: [*const f64; 2],
    (rows, dofs, expected): (usize, usize, usize),
    blocked: *mut f64,
    ask: impl Fn(&[f64], &[f64], &mut Workspace) -> Result<Option<f64>, RobotError> + Sync,
) -> Result<(), Failure> {
    // SAFETY: guaranteed by the caller.
    unsafe {
        let from = Rows::new("starts", starts, (rows, dofs), expected)?;
        let to = Rows::new("ends", ends, (rows, dofs), expected)?;
        from.answer_both(&to, ("blocked", blocked, rows), |start, end, out| {
            let found = with_workspace(|memory| ask(start, end, memory))?;
            *out = found.unwrap_or(f64::NAN);
            Ok(())
        })
    }
}

/// Writes the `k` nearest pairs of one configuration, nearest first, and the gradients of their distances.
///
/// `configuration` has `dofs` values, rad or m; `nearest` has room for `k`; `gradients` for k x dofs values, m/rad or
/// m/m: NaN for pairs that touch or overlap. `found` is the number that is written: the lesser of `k` and the number of
/// pairs. A gradient is that of the closest points as they are.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths; `found` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_gradients(
    handle: *const Proximity,
    configuration: *const f64,
    dofs: usize,
    k: usize,
    nearest: *mut PairDistance,
    gradients: *mut f64,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        put("found", found, k.min(proximity.num_pairs()))?;
        let q = Rows::new("configuration", configuration, (1, dofs), proximity.num_dofs())?;
        let pairs = q.room(("nearest", nearest, k), k)?;
        let out =
            q.room(("gradients", gradients, k.saturating_mul(dofs)), k.saturating_mul(dofs))?;
        for (place, one) in proximity.gradients(q.row(0), k)?.iter().enumerate() {
            pairs[place] = (&one.pair).into();
            derivatives(one.gradient.as_deref(), &mut out[place * dofs..(place + 1) * dofs]);
        }
        Ok(())
    })
}

/// As `urdd_proximity_gradients`, for the pairs of a shape of the robot and a convex part of an obstacle.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_gradients(
    handle: *const WorldProximity,
    configuration: *const f64,
    dofs: usize,
    k: usize,
    nearest: *mut ObstacleDistance,
    gradients: *mut f64,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        put("found", found, k.min(world.queries.num_pairs_of_parts()))?;
        let q = Rows::new("configuration", configuration, (1, dofs), world.dofs)?;
        let pairs = q.room(("nearest", nearest, k), k)?;
        let out =
            q.room(("gradients", gradients, k.saturating_mul(dofs)), k.saturating_mul(dofs))?;
        for (place, one) in world.queries.gradients(q.row(0), k)?.iter().enumerate() {
            pairs[place] = (&one.pair).into();
            derivatives(one.gradient.as_deref(), &mut out[place * dofs..(place + 1) * dofs]);
        }
        Ok(())
    })
}

fn derivatives(gradient: Option<&[f64]>, out: &mut [f64]) {
    match gradient {
        Some(gradient) => out.copy_from_slice(gradient),
        None => out.fill(f64::NAN),
    }
}

/// Writes the pairs that touch or overlap in one configuration, with the least translation that separates them.
///
/// `configuration` has `dofs` values, rad or m; `overlaps` has room for `length`, of which the first `found` are written:
/// `found` may be more than `length`, and is at most the number of pairs.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths; `found` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_penetrations(
    handle: *const Proximity,
    configuration: *const f64,
    dofs: usize,
    overlaps: *mut Overlap,
    length: usize,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        put("found", found, 0)?;
        let q = values("configuration", configuration, dofs)?;
        let rows = Rows::new("configuration", configuration, (1, dofs), proximity.num_dofs())?;
        let out = rows.room(("overlaps", overlaps, length), length)?;
        let all = proximity.penetrations(q)?;
        put("found", found, all.len())?;
        for (out, one) in out.iter_mut().zip(&all) {
            *out = Overlap { pair: (&one.pair).into(), depth: one.depth, direction: one.direction };
        }
        Ok(())
    })
}

/// Makes shapes in which a link carries an object, whose pose is that in the link's frame. The object is checked against
/// all links that move against it, but those that it ignores: the ones that may touch it. The shapes at `handle` stay as they are.
///
/// In answers, an object has the index of its link, and `pieces` counts its parts.
///
/// Errors: `OUT_OF_RANGE` for a link; `UNKNOWN_NAME` if the object ignores an unknown link; `VALUE` if a link or an
/// attached object has its name.
///
/// # Safety
/// `handle` and `object` are null or open; `out` is null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_attach(
    handle: *const Proximity,
    link: usize,
    object: *const Obstacle,
    out: *mut *mut Proximity,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        make(out, || {
            let with = at(handle)?.0.attach(link, &at(object)?.0)?;
            Ok(Proximity(Arc::new(with)))
        })
    }
}

/// Makes the same body with its frame at another pose: a matrix, 16 values, row by row. A mesh is not decomposed again.
/// The frame of a sphere is at its centre.
///
/// Errors: `VALUE` for NaN or infinity, or a matrix that is not a rotation and a translation.
///
/// # Safety
/// `obstacle` is null or open; `pose` is null or has 16 values; `out` is null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_at(
    obstacle: *const Obstacle,
    pose: *const f64,
    out: *mut *mut Obstacle,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe { make(out, || Ok(Obstacle(at(obstacle)?.0.at(placed(pose)?)?))) }
}
