//! Distances and collisions between a robot and obstacles.

use std::sync::Arc;

use urdd_robot::{ObstacleDistance as RobotDistance, Queries, WorldProximity as RobotWorld};

use crate::failure::{Status, run};
use crate::memory::{at, at_mut, free, handle, make, plain, put_all, put_numbers};
use crate::obstacle::{Obstacle, with_moves, world_of};
use crate::proximity::Proximity;
use crate::queries::Asked;

/// The shapes of a robot and obstacles, prepared for distances.
pub struct WorldProximity(pub(crate) RobotWorld<Arc<urdd_robot::Proximity>>);

handle!(WorldProximity, "urdd_world_proximity");

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

plain!(ObstacleDistance, ObstaclePair);

/// Prepares the shapes of a robot and `count` obstacles. Skips do not apply: every shape of the robot is checked
/// against every obstacle, without the links that the obstacle ignores. What it needs of the obstacles is copied.
///
/// Errors: `UNKNOWN_NAME` if an obstacle ignores an unknown link.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_proximity_world_proximity(
    proximity: *const Proximity,
    obstacles: *const *const Obstacle,
    count: usize,
    out: *mut *mut WorldProximity,
) -> Status {
    unsafe {
        make(out, || {
            let proximity = &at(proximity)?.0;
            let bytes = PART + 2 * PAIR * proximity.num_shapes();
            let world = world_of(obstacles, count, bytes)?;
            Ok(WorldProximity(RobotWorld::new(Arc::clone(proximity), &world)?))
        })
    }
}

/// Frees a robot's shapes and obstacles. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_free(world: *mut WorldProximity) -> Status {
    unsafe { free(world) }
}

/// As `urdd_proximity_in_collision`, for the pairs of a shape of the robot and an obstacle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_in_collision(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    colliding: *mut bool,
) -> Status {
    unsafe { Asked::in_collision(handle, (configurations, rows, dofs), colliding) }
}

/// As `urdd_proximity_self_distance`, for the pairs of a shape of the robot and an obstacle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_min_distance(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
) -> Status {
    unsafe { Asked::min_distance(handle, (configurations, rows, dofs), distances) }
}

/// As `urdd_proximity_nearest`, for the pairs of a shape of the robot and a convex part of an obstacle.
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
    unsafe { Asked::nearest(handle, (configurations, rows, dofs), k, nearest, found) }
}

/// Writes the number of pairs that `urdd_world_proximity_distances` has, of a shape of the robot and an obstacle; the
/// number of pairs of a shape and a convex part of an obstacle, the most that `urdd_world_proximity_nearest` finds; and the
/// number of DOFs. Each of the three can be null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_sizes(
    handle: *const WorldProximity,
    pairs: *mut usize,
    pairs_of_parts: *mut usize,
    dofs: *mut usize,
) -> Status {
    run(|| unsafe {
        let world = &at(handle)?.0;
        put_numbers([
            ("pairs", pairs, world.num_pairs()),
            ("pairs_of_parts", pairs_of_parts, world.num_pairs_of_parts()),
            ("dofs", dofs, world.num_dofs()),
        ])
    })
}

/// Writes the pairs that are checked, in the order of `urdd_world_proximity_distances`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_pairs(
    handle: *const WorldProximity,
    pairs: *mut ObstaclePair,
    length: usize,
) -> Status {
    run(|| unsafe {
        let world = &at(handle)?.0;
        let known = world.pairs().zip(world.pair_bodies());
        let known = known.map(|(([link, piece], obstacle), body)| ObstaclePair {
            link,
            body,
            piece,
            obstacle,
        });
        put_all(("pairs", pairs, length), (world.num_pairs(), 1), known)
    })
}

/// As `urdd_proximity_distances`, for the pairs of a shape of the robot and an obstacle, in the order of
/// `urdd_world_proximity_pairs`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_distances(
    handle: *const WorldProximity,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    distances: *mut f64,
    length: usize,
) -> Status {
    unsafe { Asked::distances(handle, (configurations, rows, dofs), distances, length) }
}

/// Moves obstacles to other poses: those from index `first` on, to `count` matrices (x 16 values, row by row). Nothing is
/// prepared again, and nothing is allocated after the first call of a thread. Functions of this name alone change a handle:
/// no other thread uses it during the call. After an error, none has moved.
///
/// Errors: `OUT_OF_RANGE` if there are fewer obstacles; `VALUE` for NaN or infinity, or a matrix that is not a rotation and
/// a translation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_world_proximity_move_obstacles(
    handle: *mut WorldProximity,
    first: usize,
    poses: *const f64,
    count: usize,
) -> Status {
    run(|| unsafe {
        let world = at_mut(handle)?;
        with_moves((poses, count), |poses| Ok(world.0.move_obstacles(first, poses)?))
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
