//! Distances and collisions between a robot and obstacles.

use std::sync::Arc;

use urdd_robot::{ObstacleDistance as RobotDistance, World, WorldProximity as Queries};

use crate::failure::{Failure, Status, run};
use crate::handle::{Handle, at, free, make};
use crate::memory::{Plain, put, values};
use crate::obstacle::Obstacle;
use crate::proximity::Proximity;
use crate::rows::Rows;
use crate::workspace::with_workspace;

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
    /// The index of the link.
    pub link: usize,
    /// The index of the link's piece; 0 for a hull and its bounding volumes.
    pub piece: usize,
    /// The index of the obstacle.
    pub obstacle: usize,
    /// Metres; 0 if they touch or overlap.
    pub distance: f64,
    /// The closest points, of the link's shape and of the obstacle, in the root link's frame, metres. If the two
    /// overlap, both are the same point, which is in both.
    pub points: [[f64; 3]; 2],
}

// SAFETY: zeros are numbers.
unsafe impl Plain for ObstacleDistance {}
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
/// that is written of each row: less than `k` if there are fewer pairs.
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
        put("found", found, k.min(world.queries.num_pairs_of_parts()))?;
        let q = Rows::new("configurations", configurations, (rows, dofs), world.dofs)?;
        q.answer(("nearest", nearest, rows.saturating_mul(k)), k, |q, out| {
            for (out, pair) in out.iter_mut().zip(world.queries.nearest(q, k)?) {
                *out = (&pair).into();
            }
            Ok(())
        })
    })
}

impl From<&RobotDistance> for ObstacleDistance {
    fn from(found: &RobotDistance) -> Self {
        ObstacleDistance {
            link: found.link_idx,
            piece: found.piece,
            obstacle: found.obstacle_idx,
            distance: found.distance,
            points: found.points,
        }
    }
}
