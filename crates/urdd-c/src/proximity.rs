//! Distances and collisions between the links of a robot.

use std::ffi::c_char;
use std::sync::{Arc, OnceLock};

use urdd_robot::{PairDistance as RobotPair, RobotError, ShapeKind};

use crate::failure::{Failure, Status, run};
use crate::handle::{Handle, at, free, make};
use crate::memory::{Plain, exact_room, put, read_text, room};
use crate::robot::Robot;
use crate::rows::Rows;
use crate::text::Owned;
use crate::workspace::with_workspace;

/// The shapes of one kind of a robot, prepared for distances.
pub struct Proximity(pub(crate) Arc<urdd_robot::Proximity>, OnceLock<Vec<Owned>>);

impl Proximity {
    pub(crate) fn new(proximity: urdd_robot::Proximity) -> Self {
        Proximity(Arc::new(proximity), OnceLock::new())
    }

    /// The names of links and attached objects, for C.
    pub(crate) fn names(&self) -> &[Owned] {
        self.1.get_or_init(|| {
            let names = (0..self.0.num_bodies()).filter_map(|body| self.0.body_name(body));
            names.map(Owned::new).collect()
        })
    }
}

impl Handle for Proximity {
    const NAME: &'static str = "urdd_proximity";
}

/// Two shapes that are checked against each other.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    /// The indices of their links; for an attached object, of the link that carries it.
    pub links: [usize; 2],
    /// The indices of the two bodies: of the links, or, from the number of links on, of the attached objects in the order
    /// in which they were attached. `urdd_proximity_body_name` has their names.
    pub bodies: [usize; 2],
    /// The indices of the pieces of these links; 0 for hulls and their bounding volumes.
    pub pieces: [usize; 2],
}

/// Two shapes, their distance, and their closest points.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct PairDistance {
    /// The two shapes.
    pub pair: Pair,
    /// Metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The distance divided by the pair's mean distance in link_shapes_distance_statistics_module; NaN without.
    pub relative: f64,
    /// The closest points, of the first shape and of the second, in the root link's frame, metres. If the shapes
    /// overlap, both are the same point, which is in both.
    pub points: [[f64; 3]; 2],
}

// SAFETY: zeros are numbers.
unsafe impl Plain for Pair {}
// SAFETY: as above.
unsafe impl Plain for PairDistance {}

impl From<RobotPair> for PairDistance {
    fn from(found: RobotPair) -> Self {
        let (links, bodies) = (found.link_idxs, found.body_idxs);
        PairDistance {
            pair: Pair { links, bodies, pieces: found.pieces },
            distance: found.distance,
            relative: found.relative.unwrap_or(f64::NAN),
            points: found.points,
        }
    }
}

/// Prepares the shapes of a kind, without the pairs that the URDD skips. It reads the meshes.
///
/// `kind` is "hulls", "boxes", "spheres", "pieces", "piece-boxes" or "piece-spheres".
///
/// Errors: `UNKNOWN_NAME` for the kind; `MISSING_MODULE`, `UNUSABLE`: the module of the shapes, a skips module,
/// chain_module or dof_module, or a mesh.
///
/// # Safety
/// `handle` is null or open; `kind` is null or ends with a zero byte; `out` is null or has room for a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_proximity(
    handle: *const Robot,
    kind: *const c_char,
    out: *mut *mut Proximity,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        make(out, || {
            let robot = at(handle)?;
            let made = robot.robot.proximity(shape_kind(read_text("kind", kind)?)?)?;
            Ok(Proximity::new(made))
        })
    }
}

pub(crate) fn shape_kind(name: &str) -> Result<ShapeKind, Failure> {
    let kind = name.parse::<ShapeKind>();
    kind.map_err(|error| RobotError::from(error).into())
}

/// Frees a proximity. What was made of it stays. Null is ignored.
///
/// # Safety
/// `proximity` is null, or open and not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_free(proximity: *mut Proximity) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe { free(proximity) }
}

/// Writes the number of shapes, of pairs that are checked, and of DOFs. Each of the three can be null.
///
/// # Safety
/// `handle` is null or open; each of the three is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_sizes(
    handle: *const Proximity,
    shapes: *mut usize,
    pairs: *mut usize,
    dofs: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        for (what, out, number) in [
            ("shapes", shapes, proximity.num_shapes()),
            ("pairs", pairs, proximity.num_pairs()),
            ("dofs", dofs, proximity.num_dofs()),
        ] {
            if !out.is_null() {
                put(what, out, number)?;
            }
        }
        Ok(())
    })
}

/// Writes the pairs that are checked, in the order of `urdd_proximity_distances`.
///
/// Errors: `LENGTH`.
///
/// # Safety
/// `handle` is null or open; there is room for `length` pairs at `pairs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_pairs(
    handle: *const Proximity,
    pairs: *mut Pair,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let out = exact_room("pairs", pairs, length, (proximity.num_pairs(), 1))?;
        let known = proximity.pairs().zip(proximity.pair_bodies());
        for (out, ([a, b], bodies)) in out.iter_mut().zip(known) {
            *out = Pair { links: [a.0, b.0], bodies, pieces: [a.1, b.1] };
        }
        Ok(())
    })
}

/// Writes whether any pair touches or overlaps, for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values. One row is
/// computed on this thread, without an allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_in_collision(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let q = proximity_rows(proximity, configurations, (rows, dofs))?;
        q.answer(("colliding", colliding, rows), 1, |q, out| {
            out[0] = with_workspace(|workspace| proximity.in_collision_with(q, workspace))?;
            Ok(())
        })
    })
}

/// Writes the minimum distance over all pairs for each configuration, metres: 0 in a collision, infinite without pairs.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `rows` values.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_self_distance(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let q = proximity_rows(proximity, configurations, (rows, dofs))?;
        q.answer(("distances", distances, rows), 1, |q, out| {
            let least = with_workspace(|workspace| proximity.self_distance_with(q, workspace))?;
            out[0] = least.unwrap_or(f64::INFINITY);
            Ok(())
        })
    })
}

/// Writes the distance of each pair for each configuration, metres: 0 for pairs that touch or overlap.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `length` values: rows x pairs,
/// in the order of `urdd_proximity_pairs`. One row is computed on this thread, without an allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_distances(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let q = proximity_rows(proximity, configurations, (rows, dofs))?;
        q.answer(("distances", distances, length), proximity.num_pairs(), |q, out| {
            with_workspace(|workspace| proximity.distances_with(q, workspace, out))
        })
    })
}

/// Writes the `k` nearest pairs for each configuration, nearest first, with their closest points.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `nearest` has room for rows x k. `found` is the number
/// that is written of each row: the lesser of `k` and the number of pairs. One row is computed on this thread, without an
/// allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths; `found` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_nearest(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    k: usize,
    nearest: *mut PairDistance,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let q = proximity_rows(proximity, configurations, (rows, dofs))?;
        let found = room("found", found, 1)?;
        q.answer(("nearest", nearest, rows.saturating_mul(k)), k, |q, out| {
            with_workspace(|memory| proximity.nearest_with(q, k, memory, write(out.iter_mut())))
        })?;
        found[0] = k.min(proximity.num_pairs());
        Ok(())
    })
}

/// Writes the distance and the closest points of each pair for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `closest` has room for `length`: rows x pairs, in the
/// order of `urdd_proximity_pairs`.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_closest_points(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    closest: *mut PairDistance,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let q = proximity_rows(proximity, configurations, (rows, dofs))?;
        q.answer(("closest", closest, length), proximity.num_pairs(), |q, out| {
            proximity.closest_points(q)?.into_iter().for_each(write(out.iter_mut()));
            Ok(())
        })
    })
}

/// # Safety
/// As for [`Rows::new`].
unsafe fn proximity_rows<'a>(
    proximity: &urdd_robot::Proximity,
    data: *const f64,
    shape: (usize, usize),
) -> Result<Rows<'a>, Failure> {
    // SAFETY: guaranteed by the caller.
    unsafe { Rows::new("configurations", data, shape, proximity.num_dofs()) }
}

/// Writes one answer after another.
pub(crate) fn write<'a, P, T: From<P> + 'a>(
    mut out: impl Iterator<Item = &'a mut T>,
) -> impl FnMut(P) {
    move |found| {
        if let Some(out) = out.next() {
            *out = found.into();
        }
    }
}
