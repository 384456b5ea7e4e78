//! Distances and collisions between the links of a robot.

use std::ffi::c_char;
use std::sync::{Arc, OnceLock};

use urdd_robot::{PairDistance as RobotPair, Queries, RobotError, ShapeKind};

use crate::failure::{Failure, Owned, Status, run};
use crate::memory::{at, free, handle, make, plain, put_all, put_numbers, read_text};
use crate::queries::{Asked, Rows};
use crate::robot::Robot;

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

handle!(Proximity, "urdd_proximity");

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

plain!(Pair, PairDistance);

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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_proximity(
    handle: *const Robot,
    kind: *const c_char,
    out: *mut *mut Proximity,
) -> Status {
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
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_free(proximity: *mut Proximity) -> Status {
    unsafe { free(proximity) }
}

/// Writes the number of shapes, of pairs that are checked, and of DOFs. Each of the three can be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_sizes(
    handle: *const Proximity,
    shapes: *mut usize,
    pairs: *mut usize,
    dofs: *mut usize,
) -> Status {
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        put_numbers([
            ("shapes", shapes, proximity.num_shapes()),
            ("pairs", pairs, proximity.num_pairs()),
            ("dofs", dofs, proximity.num_dofs()),
        ])
    })
}

/// Writes the pairs that are checked, in the order of `urdd_proximity_distances`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_pairs(
    handle: *const Proximity,
    pairs: *mut Pair,
    length: usize,
) -> Status {
    run(|| unsafe {
        let proximity = &at(handle)?.0;
        let known = proximity.pairs().zip(proximity.pair_bodies());
        let known =
            known.map(|([a, b], bodies)| Pair { links: [a.0, b.0], bodies, pieces: [a.1, b.1] });
        put_all(("pairs", pairs, length), (proximity.num_pairs(), 1), known)
    })
}

/// Writes whether any pair touches or overlaps, for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values. One row is
/// computed on this thread, without an allocation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_in_collision(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    unsafe { Asked::in_collision(handle, (configurations, rows, dofs), colliding) }
}

/// Writes the minimum distance over all pairs for each configuration, metres: 0 in a collision, infinite without pairs.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `rows` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_self_distance(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
) -> Status {
    unsafe { Asked::min_distance(handle, (configurations, rows, dofs), distances) }
}

/// Writes the distance of each pair for each configuration, metres: 0 for pairs that touch or overlap.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `length` values: rows x pairs,
/// in the order of `urdd_proximity_pairs`. One row is computed on this thread, without an allocation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_distances(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
    length: usize,
) -> Status {
    unsafe { Asked::distances(handle, (configurations, rows, dofs), distances, length) }
}

/// Writes the `k` nearest pairs for each configuration, nearest first, with their closest points.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `nearest` has room for rows x k. `found` is the number
/// that is written of each row: the lesser of `k` and the number of pairs. One row is computed on this thread, without an
/// allocation.
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
    unsafe { Asked::nearest(handle, (configurations, rows, dofs), k, nearest, found) }
}

/// Writes the distance and the closest points of each pair for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `closest` has room for `length`: rows x pairs, in the
/// order of `urdd_proximity_pairs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_closest_points(
    handle: *const Proximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    closest: *mut PairDistance,
    length: usize,
) -> Status {
    run(|| unsafe {
        let of = &at(handle)?.0;
        let q = Rows::new("configurations", configurations, (rows, dofs), of.num_dofs())?;
        q.answer(("closest", closest, length), of.num_pairs(), |q, out| {
            for (out, pair) in out.iter_mut().zip(of.closest_points(q)?) {
                *out = pair.into();
            }
            Ok(())
        })
    })
}
