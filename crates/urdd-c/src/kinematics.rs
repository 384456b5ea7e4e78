//! Forward kinematics.

use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose_matrix::write_matrix;

use crate::failure::{Status, run};
use crate::handle::at;
use crate::memory::triple;
use crate::robot::Robot;
use crate::workspace::with_poses;

/// Numbers of a pose.
const MATRIX: usize = 16;

/// Writes the pose of each link in the root link's frame for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m. `poses` has room for `length` values: rows x links x 4
/// x 4, a homogeneous matrix in row-major order for each link, in metres. Values beyond the bounds are allowed. One row
/// is computed on this thread, without an allocation.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link_poses(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    poses: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let width = MATRIX * robot.robot.link_names()?.len();
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        q.answer(("poses", poses, length), width, |q, out| {
            with_poses(|poses| {
                robot.robot.link_poses_into(q, poses)?;
                for (pose, out) in poses.iter().zip(out.chunks_exact_mut(MATRIX)) {
                    write_matrix(pose, out);
                }
                Ok(())
            })
        })
    })
}

/// Writes the geometric Jacobian of a link for each configuration.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m. `point` is a point of the link in the link's frame, 3
/// values in metres; null is the origin of its frame. `jacobians` has room for `length` values: rows x dofs x 6, the
/// six rows of each column together (column-major). The first three are the linear velocity of the point, the others the
/// angular velocity, both in the root link's frame. A mimic joint counts for the DOF that it follows. One row is
/// computed on this thread, without an allocation.
///
/// Errors: `OUT_OF_RANGE` for the link; `MISSING_MODULE`, `UNUSABLE`:
/// chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_jacobians(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    link: usize,
    point: *const f64,
    jacobians: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let point = match point.is_null() {
            true => [0.0; 3],
            false => triple("point", point)?,
        };
        let out = q.room(("jacobians", jacobians, length), 6 * dofs)?;
        if rows == 1 {
            return Ok(robot.robot.jacobian_into(q.values, link, point, out)?);
        }
        let on = Cancellation::default();
        Ok(robot.robot.jacobian_batch_into(q.values, link, point, &on, out)?)
    })
}
