//! Distances and collisions between a robot and obstacles.

use std::sync::Arc;

use nalgebra::Isometry3;
use urdd_robot::{ObstacleDistance as RobotDistance, World, WorldProximity as Queries};

use crate::failure::{Failure, Status, run};
use crate::handle::{Handle, at, at_mut, free, make};
use crate::memory::{Plain, enough, exact_room, put, room, values};
use crate::obstacle::{Obstacle, pose_of};
use crate::proximity::{Proximity, write};
use crate::rows::Rows;
use crate::workspace::{with_poses, with_workspace};

/// The shapes of a robot and obstacles, prepared for distances.
pub struct WorldProximity {
    pub(crate) queries: Queries<Arc<urdd_robot::Proximity>>,
    pub(crate) dofs: usize,
}

impl Handle for WorldProximity {
    const NAME: &'static str = "urdd_world_proximity";
}

/// A shape of the robot and an obstacle, their distance, and their closest points.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ObstacleDistance {
    /// The index of the link; for an attached object, of the link that carries it.
    pub link: usize,
    /// The index of the body: of the link, or, from the number of links on, of the attached object.
    pub body: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    pub piece: usize,
    /// The index of the obstacle.
    pub obstacle: usize,
    /// Metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points, of the link's shape and of the obstacle, in the root link's frame, metres. If the two
    /// overlap, both are the same point, which is in both.
    pub points: [[f64; 3]; 2],
}

/// A shape of the robot and an obstacle that are checked against each other.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct ObstaclePair {
    /// The index of the link; for an attached object, of the link that carries it.
    pub link: usize,
    /// The index of the body: of the link, or, from the number of links on, of the attached object.
    pub body: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes. For an attached object, of its part.
    pub piece: usize,
    /// The index of the obstacle.
    pub obstacle: usize,
}

/// Memory of a part of an obstacle, and of a pair with a shape of the robot, bytes.
const PART: usize = 1024;
const PAIR: usize = 8;

// SAFETY: zeros are numbers.
unsafe impl Plain for ObstacleDistance {}
// SAFETY: as above.
unsafe impl Plain for ObstaclePair {}
// SAFETY: zeros are null pointers.
unsafe impl Plain for *const Obstacle {}

/// Prepares the shapes of a robot and `count` obstacles. Skips do not apply: every shape of the robot is checked
/// against every obstacle, without the links that the obstacle ignores. What it needs of the obstacles is copied.
///
/// Errors: `UNKNOWN_NAME` if an obstacle ignores an unknown link.
///
/// # Safety
/// `proximity` is null or open; there are `count` handles at `obstacles`, null or open; `out` is null or has room for a
/// pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_world_proximity(
    proximity: *const Proximity,
    obstacles: *const *const Obstacle,
    count: usize,
    out: *mut *mut WorldProximity,
) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe {
        make(out, || {
            let proximity = &at(proximity)?.0;
            let obstacles = values("obstacles", obstacles, count)?;
            let parts = obstacles.iter().map(|obstacle| Ok(at(*obstacle)?.0.num_parts()));
            let parts = parts.sum::<Result<usize, Failure>>()?;
            enough("obstacles", parts, PART + 2 * PAIR * proximity.num_shapes())?;
            let each = obstacles.iter().map(|obstacle| Ok(at(*obstacle)?.0.clone()));
            let world = World::new(each.collect::<Result<Vec<_>, Failure>>()?);
            Ok(WorldProximity {
                dofs: proximity.num_dofs(),
                queries: Queries::new(Arc::clone(proximity), &world)?,
            })
        })
    }
}

/// Frees a robot's shapes and obstacles. Null is ignored.
///
/// # Safety
/// `world` is null, or open and not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_free(world: *mut WorldProximity) -> Status {
    // SAFETY: guaranteed by the caller.
    unsafe { free(world) }
}

/// Writes whether any shape of the robot touches or overlaps an obstacle, for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `colliding` has room for `rows` values. One row is
/// computed on this thread, without an allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_in_collision(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        q.answer(("colliding", colliding, rows), 1, |q, out| {
            out[0] = with_workspace(|workspace| world.queries.in_collision_with(q, workspace))?;
            Ok(())
        })
    })
}

/// Writes the minimum distance between the robot and the obstacles for each configuration, metres: 0 in a collision,
/// infinite without pairs.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `rows` values.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_min_distance(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        q.answer(("distances", distances, rows), 1, |q, out| {
            let least = with_workspace(|workspace| world.queries.min_distance_with(q, workspace))?;
            out[0] = least.unwrap_or(f64::INFINITY);
            Ok(())
        })
    })
}

/// Writes the `k` nearest pairs of a shape of the robot and a convex part of an obstacle for each configuration,
/// nearest first, with their closest points.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `nearest` has room for rows x k. `found` is the number
/// that is written of each row: less than `k` if there are fewer pairs. One row is computed on this thread, without an
/// allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths; `found` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_nearest(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    k: usize,
    nearest: *mut ObstacleDistance,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        let found = room("found", found, 1)?;
        q.answer(("nearest", nearest, rows.saturating_mul(k)), k, |q, out| {
            let out = write(out.iter_mut());
            with_workspace(|memory| world.queries.nearest_with(q, k, memory, out))
        })?;
        found[0] = k.min(world.queries.num_pairs_of_parts());
        Ok(())
    })
}

/// Writes the number of pairs that `urdd_world_proximity_distances` has, of a shape of the robot and an obstacle; the
/// number of pairs of a shape and a convex part of an obstacle, the most that `urdd_world_proximity_nearest` finds; and the
/// number of DOFs. Each of the three can be null.
///
/// # Safety
/// `handle` is null or open; each of the three is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_sizes(
    handle: *const WorldProximity,
    pairs: *mut usize,
    pairs_of_parts: *mut usize,
    dofs: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        for (what, out, number) in [
            ("pairs", pairs, world.queries.num_pairs()),
            ("pairs_of_parts", pairs_of_parts, world.queries.num_pairs_of_parts()),
            ("dofs", dofs, world.dofs),
        ] {
            if !out.is_null() {
                put(what, out, number)?;
            }
        }
        Ok(())
    })
}

/// Writes the pairs that are checked, in the order of `urdd_world_proximity_distances`.
///
/// Errors: `LENGTH`.
///
/// # Safety
/// `handle` is null or open; there is room for `length` pairs at `pairs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_pairs(
    handle: *const WorldProximity,
    pairs: *mut ObstaclePair,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let queries = &at(handle)?.queries;
        let out = exact_room("pairs", pairs, length, (queries.num_pairs(), 1))?;
        let known = queries.pairs().zip(queries.pair_bodies());
        for (out, (([link, piece], obstacle), body)) in out.iter_mut().zip(known) {
            *out = ObstaclePair { link, body, piece, obstacle };
        }
        Ok(())
    })
}

/// Writes the distance of each pair of a shape of the robot and an obstacle for each configuration, metres: 0 for pairs
/// that touch or overlap.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `distances` has room for `length` values: rows x pairs,
/// in the order of `urdd_world_proximity_pairs`. One row is computed on this thread, without an allocation.
///
/// Errors: `LENGTH`; `VALUE` for NaN or infinity.
///
/// # Safety
/// `handle` is null or open; the arrays have their lengths.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_distances(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
    length: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at(handle)?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        q.answer(("distances", distances, length), world.queries.num_pairs(), |q, out| {
            with_workspace(|memory| world.queries.distances_with(q, memory, out))
        })
    })
}

/// Moves obstacles to other poses: those from index `first` on, to `count` matrices (x 16 values, row by row). Nothing is
/// prepared again, and nothing is allocated after the first call of a thread. This is the one function that changes a
/// handle: no other thread uses it during the call. After an error, none has moved.
///
/// Errors: `OUT_OF_RANGE` if there are fewer obstacles; `VALUE` for NaN or infinity, or a matrix that is not a rotation and
/// a translation.
///
/// # Safety
/// `handle` is null, or open and not used elsewhere; `poses` has 16 x `count` values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_move_obstacles(
    handle: *mut WorldProximity,
    first: usize,
    poses: *const f64,
    count: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let world = at_mut(handle)?;
        let matrices = values("poses", poses, count.saturating_mul(16))?;
        with_poses(|poses| {
            poses.clear();
            if poses.capacity() < count {
                enough("poses", count, 2 * size_of::<Isometry3<f64>>())?;
            }
            for matrix in matrices.chunks_exact(16) {
                poses.push(pose_of(matrix)?);
            }
            Ok(world.queries.move_obstacles(first, poses)?)
        })
    })
}

impl From<RobotDistance> for ObstacleDistance {
    fn from(found: RobotDistance) -> Self {
        ObstacleDistance {
            link: found.link_idx,
            body: found.body_idx,
            piece: found.piece,
            obstacle: found.obstacle_idx,
            distance: found.distance,
            points: found.points,
        }
    }
}
