//! Limits of DOFs, and masses.

use urdd_robot::RobotError;

use crate::failure::{Status, run};
use crate::handle::at;
use crate::memory::put_all;
use crate::robot::Robot;

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
