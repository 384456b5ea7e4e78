//! What planners ask beside distances: margins, motions, gradients, overlaps.

use urdd_robot::{EdgeSettings, FirstContact, Overlap as RobotOverlap, RobotError, Workspace};

use crate::failure::{Failure, Status, run};
use crate::handle::at;
use crate::memory::{Plain, room};
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

/// A shape of the robot and an obstacle that touch or overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ObstacleOverlap {
    /// The two. Their distance is 0; the points are those that touch once the obstacle has moved, before it moves.
    pub pair: ObstacleDistance,
    /// The length of the least translation that separates the two, metres; 0 if they touch.
    pub depth: f64,
    /// The unit vector, in the root link's frame, along which the obstacle would move.
    pub direction: [f64; 3],
}

// SAFETY: zeros are numbers.
unsafe impl Plain for Overlap {}
// SAFETY: zeros are numbers.
unsafe impl Plain for ObstacleOverlap {}

impl From<RobotOverlap<urdd_robot::PairDistance>> for Overlap {
    fn from(found: RobotOverlap<urdd_robot::PairDistance>) -> Self {
        let (depth, direction) = (found.depth, found.direction);
        Overlap { pair: found.pair.into(), depth, direction }
    }
}

impl From<RobotOverlap<urdd_robot::ObstacleDistance>> for ObstacleOverlap {
    fn from(found: RobotOverlap<urdd_robot::ObstacleDistance>) -> Self {
        let (depth, direction) = (found.depth, found.direction);
        ObstacleOverlap { pair: found.pair.into(), depth, direction }
    }
}

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
/// which no point of the robot travels farther, the end and the halves first: the answer is one that is blocked, and need
/// not be the first, which `urdd_proximity_first_contact` has. With 0, the motion is proved free by conservative
/// advancement; it then needs 0.1 mm more than the margin, and the answer is the first part where it has less.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity, a margin or a resolution below 0, or a motion that needs more than a
/// million configurations, or 100,000 steps of a proof.
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
        edges([starts, ends], shape, ("blocked", blocked, rows), |start, end, memory| {
            let settings = settings(margin, resolution);
            Ok(part(proximity.blocked_edge_with(start, end, &settings, memory)?))
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
        edges([starts, ends], shape, ("blocked", blocked, rows), |start, end, memory| {
            let settings = settings(margin, resolution);
            Ok(part(world.queries.blocked_edge_with(start, end, &settings, memory)?))
        })
    })
}

/// Writes where each straight motion is blocked by the robot itself first, and how far it is free.
///
/// As `urdd_proximity_blocked_edge`; `contacts` has room for `length` values, rows x 2: the last part of the motion that is
/// known to be free (0 if the start is not), then the first that is not; both NaN where the motion is free. With a
/// resolution, configurations are checked in order, and the part between the first that is blocked and the one before is
/// halved ten times: between the two no point of the robot travels farther than a thousandth of the resolution. A contact
/// that begins and ends between two configurations can be missed. With 0, all up to the first part is proved free.
///
/// Errors: as there.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_first_contact(
    handle: *const Proximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    contacts: *mut f64,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let shape = (rows, dofs, proximity.num_dofs());
        edges([starts, ends], shape, ("contacts", contacts, length), |start, end, memory| {
            let settings = settings(margin, resolution);
            Ok(parts(proximity.first_contact_with(start, end, &settings, memory)?))
        })
    })
}

/// As `urdd_proximity_first_contact`, for motions that obstacles block.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_first_contact(
    handle: *const WorldProximity,
    starts: *const f64,
    ends: *const f64,
    rows: usize,
    dofs: usize,
    margin: f64,
    resolution: f64,
    contacts: *mut f64,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let shape = (rows, dofs, world.dofs);
        edges([starts, ends], shape, ("contacts", contacts, length), |start, end, memory| {
            let settings = settings(margin, resolution);
            Ok(parts(world.queries.first_contact_with(start, end, &settings, memory)?))
        })
    })
}

fn settings(margin: f64, resolution: f64) -> EdgeSettings {
    let resolution = (resolution != 0.0).then_some(resolution);
    EdgeSettings { margin, resolution }
}

fn part(blocked: Option<f64>) -> [f64; 1] {
    [blocked.unwrap_or(f64::NAN)]
}

fn parts(contact: Option<FirstContact>) -> [f64; 2] {
    contact.map_or([f64::NAN; 2], |contact| [contact.free, contact.blocked])
}

/// # Safety
/// As for [`Rows::new`].
unsafe fn edges<const N: usize>(
    [starts, ends]: [*const f64; 2],
    (rows, dofs, expected): (usize, usize, usize),
    out: (&'static str, *mut f64, usize),
    ask: impl Fn(&[f64], &[f64], &mut Workspace) -> Result<[f64; N], RobotError> + Sync,
) -> Result<(), Failure> {
    // SAFETY: guaranteed by the caller.
    unsafe {
        let from = Rows::new("starts", starts, (rows, dofs), expected)?;
        let to = Rows::new("ends", ends, (rows, dofs), expected)?;
        from.answer_both(&to, out, N, |start, end, out| {
            out.copy_from_slice(&with_workspace(|memory| ask(start, end, memory))?);
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
        let q = Rows::new("configuration", configuration, (1, dofs), proximity.num_dofs())?;
        gradients_of(q, (nearest, gradients, k, found), |memory, each| {
            proximity.gradients_with(q.row(0), k, memory, each)
        })
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
        let q = Rows::new("configuration", configuration, (1, dofs), world.dofs)?;
        gradients_of(q, (nearest, gradients, k, found), |memory, each| {
            world.queries.gradients_with(q.row(0), k, memory, each)
        })
    })
}

/// Writes pairs and gradients that `ask` passes on.
///
/// # Safety
/// As for [`room`]: `nearest` has room for `k`, `gradients` for `k` rows.
unsafe fn gradients_of<P, T: Plain + From<P>>(
    q: Rows,
    (nearest, gradients, k, found): (*mut T, *mut f64, usize, *mut usize),
    ask: impl FnOnce(&mut Workspace, &mut dyn FnMut(P, Option<&[f64]>)) -> Result<(), RobotError>,
) -> Result<(), Failure> {
    let dofs = q.values.len();
    // SAFETY: guaranteed by the caller.
    let (pairs, out, found) = unsafe {
        let pairs = room("nearest", nearest, k)?;
        let out = room("gradients", gradients, k.saturating_mul(dofs))?;
        (pairs, out, &mut room("found", found, 1)?[0])
    };
    with_workspace(|memory| {
        ask(memory, &mut |pair, gradient| {
            pairs[*found] = pair.into();
            let out = &mut out[*found * dofs..(*found + 1) * dofs];
            match gradient {
                Some(gradient) => out.copy_from_slice(gradient),
                None => out.fill(f64::NAN),
            }
            *found += 1;
        })
    })?;
    Ok(())
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
        let q = Rows::new("configuration", configuration, (1, dofs), proximity.num_dofs())?;
        let all = proximity.penetrations(q.row(0));
        overlaps_of(all, overlaps, length, found)
    })
}

/// As `urdd_proximity_penetrations`, for the pairs of a shape of the robot and a convex part of an obstacle.
///
/// # Safety
/// As there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_penetrations(
    handle: *const WorldProximity,
    configuration: *const f64,
    dofs: usize,
    overlaps: *mut ObstacleOverlap,
    length: usize,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configuration", configuration, (1, dofs), world.dofs)?;
        let all = world.queries.penetrations(q.row(0));
        overlaps_of(all, overlaps, length, found)
    })
}

/// # Safety
/// As for [`room`].
unsafe fn overlaps_of<P, T: Plain + From<RobotOverlap<P>>>(
    all: Result<Vec<RobotOverlap<P>>, RobotError>,
    overlaps: *mut T,
    length: usize,
    found: *mut usize,
) -> Result<(), Failure> {
    // SAFETY: guaranteed by the caller.
    let (out, found) =
        unsafe { (room("overlaps", overlaps, length)?, &mut room("found", found, 1)?[0]) };
    let all = all?;
    *found = all.len();
    for (out, one) in out.iter_mut().zip(all) {
        *out = one.into();
    }
    Ok(())
}
