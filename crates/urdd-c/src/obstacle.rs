//! Obstacles around a robot.

use std::{ffi::c_char, ptr};

use nalgebra::Isometry3;
use urdd_geometry::Mesh;
use urdd_kinematics::pose::pose;
use urdd_robot::{Obstacle as RobotObstacle, World};

use crate::failure::{Failure, Status};
use crate::memory::{at, enough, free, handle, make, plain, read_text, triple, values, with_poses};
use crate::names::out_of_range;

/// A body that a robot must not touch, in the root link's frame.
pub struct Obstacle(pub(crate) RobotObstacle);

/// Bytes that are asked for beforehand for each point of a hull, which takes 360 to 570; and for each vertex and triangle
/// of a mesh, which takes 2,000.
const HULL: usize = 768;
const MESH: usize = 4096;

/// Bytes of a point of a cloud, or of a cell of a field of heights, while the tree of them is made.
const COPY: usize = 256;

plain!(*const Obstacle);

handle!(Obstacle, "urdd_obstacle");

/// The pose at `matrix`, 16 values; null is the identity.
pub(crate) unsafe fn placed(matrix: *const f64) -> Result<Isometry3<f64>, Failure> {
    if matrix.is_null() {
        return Ok(Isometry3::identity());
    }
    pose_of(unsafe { values("pose", matrix, 16) }?)
}

pub(crate) fn pose_of(matrix: &[f64]) -> Result<Isometry3<f64>, Failure> {
    pose(matrix).ok_or_else(|| {
        let message = "the pose is not a rotation and a translation";
        Failure::new(Status::Value, message)
    })
}

/// Makes an obstacle with a name at a pose.
unsafe fn named(
    name: *const c_char,
    pose: *const f64,
    out: *mut *mut Obstacle,
    act: impl FnOnce(&str, Isometry3<f64>) -> Result<RobotObstacle, Failure>,
) -> Status {
    unsafe { make(out, || Ok(Obstacle(act(read_text("name", name)?, placed(pose)?)?))) }
}

/// Makes a box: the pose of its centre and axes, and its 3 half extents, metres.
///
/// `pose` is a homogeneous 4 x 4 matrix in row-major order; null is the identity.
///
/// Errors: `VALUE` for a size that is negative, not finite or larger than 1e9 m, and for a pose that is not a rotation
/// and a translation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_cuboid(
    name: *const c_char,
    pose: *const f64,
    half_extents: *const f64,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, pose, out, |name, pose| {
            Ok(RobotObstacle::cuboid(name, pose, triple("half_extents", half_extents)?)?)
        })
    }
}

/// Makes a sphere: its centre (3 values) and radius, metres.
///
/// Errors: as `urdd_obstacle_cuboid`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_sphere(
    name: *const c_char,
    centre: *const f64,
    radius: f64,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, ptr::null(), out, |name, _| {
            Ok(RobotObstacle::sphere(name, triple("centre", centre)?, radius)?)
        })
    }
}

/// Makes a capsule: all points within `radius` of a segment along the z axis of its frame, from -`half_length` to
/// `half_length`, metres.
///
/// Errors: as `urdd_obstacle_cuboid`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_capsule(
    name: *const c_char,
    pose: *const f64,
    radius: f64,
    half_length: f64,
    out: *mut *mut Obstacle,
) -> Status {
    let make = |name: &str, pose| Ok(RobotObstacle::capsule(name, pose, radius, half_length)?);
    unsafe { named(name, pose, out, make) }
}

/// Makes a cylinder along the z axis of its frame, from -`half_length` to `half_length`, metres. It is approximated by
/// a circumscribed prism with 64 sides, which exceeds the radius by up to 0.13 %.
///
/// Errors: as `urdd_obstacle_cuboid`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_cylinder(
    name: *const c_char,
    pose: *const f64,
    radius: f64,
    half_length: f64,
    out: *mut *mut Obstacle,
) -> Status {
    let make = |name: &str, pose| Ok(RobotObstacle::cylinder(name, pose, radius, half_length)?);
    unsafe { named(name, pose, out, make) }
}

/// Makes the convex hull of `count` points (count x 3), metres.
///
/// Errors: as `urdd_obstacle_cuboid`, and `VALUE` without points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_hull(
    name: *const c_char,
    pose: *const f64,
    points: *const f64,
    count: usize,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, pose, out, |name, pose| {
            let points = values("points", points, count.saturating_mul(3))?.as_chunks().0;
            enough("points", count, HULL)?;
            Ok(RobotObstacle::hull(name, pose, points)?)
        })
    }
}

/// Makes a mesh of `num_vertices` vertices (x 3), metres, and `num_triangles` triangles (x 3 indices), decomposed into
/// convex pieces as `urdd generate` does, at the same cost. `urdd_obstacle_hull` is fast, and fills cavities.
///
/// Errors: as `urdd_obstacle_hull`, and `OUT_OF_RANGE` for a vertex index.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_mesh(
    name: *const c_char,
    pose: *const f64,
    vertices: *const f64,
    num_vertices: usize,
    triangles: *const u32,
    num_triangles: usize,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, pose, out, |name, pose| {
            let vertices = values("vertices", vertices, num_vertices.saturating_mul(3))?;
            let triangles = values("triangles", triangles, num_triangles.saturating_mul(3))?;
            enough("vertices", num_vertices.saturating_add(num_triangles), MESH)?;
            if let Some(index) = triangles.iter().find(|index| **index as usize >= num_vertices) {
                return Err(out_of_range("vertex", *index as usize, num_vertices));
            }
            let vertices = vertices.as_chunks().0.to_vec();
            let mesh = Mesh { vertices, triangles: triangles.as_chunks().0.to_vec() };
            Ok(RobotObstacle::mesh(name, pose, &mesh)?)
        })
    }
}

/// Makes a cloud of `count` points (count x 3), metres, such as a depth camera sees: all points that are at most `radius`
/// from one of them; 0 is allowed. It is one part, in which a tree finds the points near a shape: 100,000 are fine.
///
/// Errors: as `urdd_obstacle_hull`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_points(
    name: *const c_char,
    pose: *const f64,
    points: *const f64,
    count: usize,
    radius: f64,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, pose, out, |name, pose| {
            RobotObstacle::check_count(name, count)?;
            let points = values("points", points, count.saturating_mul(3))?.as_chunks().0;
            enough("points", count, COPY)?;
            Ok(RobotObstacle::points(name, pose, points, radius)?)
        })
    }
}

/// Makes a field of heights over the x-y plane of its frame: `rows` x `columns` columns, row by row, each with the 2 sizes
/// `cell` along x and y, metres. The centre of one is at `x = column * cell[0]`, `y = row * cell[1]`. It reaches from its height,
/// metres, `thickness` down. There are no slopes between cells.
///
/// Errors: as `urdd_obstacle_cuboid`, and `VALUE` without heights.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_height_field(
    name: *const c_char,
    pose: *const f64,
    heights: *const f64,
    rows: usize,
    columns: usize,
    cell: *const f64,
    thickness: f64,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        named(name, pose, out, |name, pose| {
            let count = rows.saturating_mul(columns);
            RobotObstacle::check_count(name, count)?;
            let (heights, cell) = (values("heights", heights, count)?, values("cell", cell, 2)?);
            enough("heights", count, COPY)?;
            let cell = [cell[0], cell[1]];
            Ok(RobotObstacle::height_field(name, pose, heights, columns, cell, thickness)?)
        })
    }
}

/// Makes the same obstacle again, with a link that may touch it, such as the base that is mounted on it. `obstacle`
/// stays as it is.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_ignoring(
    obstacle: *const Obstacle,
    link: *const c_char,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe {
        make(out, || {
            let link = read_text("link", link)?;
            Ok(Obstacle(at(obstacle)?.0.clone().ignoring(link)))
        })
    }
}

/// Makes the same body with its frame at another pose: a matrix, 16 values, row by row. Nothing is prepared again: the
/// two share their shapes. The frame of a sphere is at its centre. `urdd_world_proximity_move_obstacles` moves without a
/// new handle.
///
/// Errors: `VALUE` for NaN or infinity, or a matrix that is not a rotation and a translation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_at(
    obstacle: *const Obstacle,
    pose: *const f64,
    out: *mut *mut Obstacle,
) -> Status {
    unsafe { make(out, || Ok(Obstacle(at(obstacle)?.0.at(placed(pose)?)?))) }
}

/// Frees an obstacle. What was made of it stays. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_obstacle_free(obstacle: *mut Obstacle) -> Status {
    unsafe { free(obstacle) }
}

/// A world of the caller's obstacles. What is made of it takes `bytes` for each part of them.
pub(crate) unsafe fn world_of(
    obstacles: *const *const Obstacle,
    count: usize,
    bytes: usize,
) -> Result<World, Failure> {
    let obstacles = unsafe { values("obstacles", obstacles, count) }?;
    let parts = obstacles.iter().map(|obstacle| Ok(unsafe { at(*obstacle) }?.0.num_parts()));
    let parts = parts.sum::<Result<usize, Failure>>()?;
    enough("obstacles", parts, bytes)?;
    let each = obstacles.iter().map(|obstacle| Ok(unsafe { at(*obstacle) }?.0.clone()));
    Ok(World::new(each.collect::<Result<Vec<_>, Failure>>()?))
}

/// Runs with the poses at `poses`, `count` matrices. Nothing is allocated after the first call of a thread.
pub(crate) unsafe fn with_moves(
    (poses, count): (*const f64, usize),
    act: impl FnOnce(&[Isometry3<f64>]) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let matrices = unsafe { values("poses", poses, count.saturating_mul(16)) }?;
    with_poses(|poses| {
        poses.clear();
        if poses.capacity() < count {
            enough("poses", count, 2 * size_of::<Isometry3<f64>>())?;
        }
        for matrix in matrices.chunks_exact(16) {
            poses.push(pose_of(matrix)?);
        }
        act(poses)
    })
}
