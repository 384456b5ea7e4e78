//! Forward kinematics, limits of DOFs, masses, and what gravity does to them.

use urdd_directory::cancellation::Cancellation;
use urdd_kinematics::pose::write_matrix;
use urdd_robot::{GravitySettings, Payload, RobotError};

use crate::failure::{Failure, Status, run};
use crate::memory::{at, put_all, triple, with_poses};
use crate::robot::Robot;

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
        let point = point_at(point)?;
        let out = q.room(("jacobians", jacobians, length), 6 * dofs)?;
        if rows == 1 {
            return Ok(robot.robot.jacobian_into(q.values, link, point, out)?);
        }
        let on = Cancellation::default();
        Ok(robot.robot.jacobian_batch_into(q.values, link, point, &on, out)?)
    })
}

/// A point of a link; null is the origin of its frame.
unsafe fn point_at(point: *const f64) -> Result<[f64; 3], Failure> {
    if point.is_null() { Ok([0.0; 3]) } else { unsafe { triple("point", point) } }
}

unsafe fn limits(
    handle: *const Robot,
    (limits, dofs): (*mut f64, usize),
    of: impl FnOnce(&urdd_robot::Robot) -> Result<&[f64], RobotError>,
) -> Status {
    run(|| unsafe {
        let known = of(&at(handle)?.robot)?;
        put_all(("limits", limits, dofs), (1, known.len()), known.iter().copied())
    })
}

/// Writes the largest speed of each DOF, rad/s or m/s, as the source states it; infinite where it states none. `dofs`
/// values.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: bounds_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_velocity_limits(
    handle: *const Robot,
    limits: *mut f64,
    dofs: usize,
) -> Status {
    unsafe { self::limits(handle, (limits, dofs), urdd_robot::Robot::velocity_limits) }
}

/// As `urdd_robot_velocity_limits`, for the largest effort of each DOF, N m or N.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_effort_limits(
    handle: *const Robot,
    limits: *mut f64,
    dofs: usize,
) -> Status {
    unsafe { self::limits(handle, (limits, dofs), urdd_robot::Robot::effort_limits) }
}

/// Writes the mass of each link, kg, 0 where the source states none, and its centre of mass in the link's frame, metres:
/// links x 4 values.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: urdf_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link_masses(
    handle: *const Robot,
    masses: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.link_masses()?;
        let each = known.iter().flat_map(|link| {
            let [x, y, z] = link.centre;
            [link.mass, x, y, z]
        });
        put_all(("masses", masses, length), (known.len(), 4), each)
    })
}

/// Writes the centre of mass of the robot in the root link's frame for each configuration, metres; NaN for a robot whose
/// source states no mass.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m; `centres` has room for rows x 3 values.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: urdf_module, chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_centre_of_mass(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    centres: *mut f64,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let length = rows.saturating_mul(3);
        q.answer(("centres", centres, length), 3, |q, out| {
            let centre = robot.robot.centre_of_mass(q)?;
            out.copy_from_slice(&centre.unwrap_or([f64::NAN; 3]));
            Ok(())
        })
    })
}

/// Writes the torque (N m) or force (N) of each DOF that holds the robot still against gravity, for each configuration. It
/// is what the motors must give, positive where the DOF must push toward larger values. A mimic joint counts for the DOF
/// that it follows; of a rotation vector, the values are derivatives with respect to its components.
///
/// `configurations` has `rows` rows of `dofs` values, rad or m. `gravity` is 3 values in the root link's frame, m/s^2; null
/// is (0, 0, -9.81). `payload` is a mass in kg that `link` carries at `point`, 3 values in the link's frame in metres; null
/// is the origin of its frame. With a payload of 0, neither `link` nor `point` is read. `torques` has room for `length`
/// values: rows x dofs. One row is computed on this thread, without an allocation.
///
/// Errors: `VALUE` for a payload below 0, and for numbers that are not finite; `OUT_OF_RANGE` for the link;
/// `MISSING_MODULE`, `UNUSABLE`: urdf_module, chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_gravity_torques(
    handle: *const Robot,
    configurations: *const f64,
    rows: usize,
    dofs: usize,
    gravity: *const f64,
    payload: f64,
    link: usize,
    point: *const f64,
    torques: *mut f64,
    length: usize,
) -> Status {
    run(|| unsafe {
        let robot = at(handle)?;
        let q = robot.rows("configurations", configurations, (rows, dofs))?;
        let mut settings = GravitySettings::default();
        if !gravity.is_null() {
            settings.gravity = triple("gravity", gravity)?;
        }
        if payload != 0.0 {
            settings.payload = Some(Payload { link, mass: payload, point: point_at(point)? });
        }
        q.answer(("torques", torques, length), dofs, |q, out| {
            robot.robot.gravity_torques_into(q, &settings, out)
        })
    })
}
