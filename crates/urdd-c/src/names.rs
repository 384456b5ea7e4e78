//! Links, joints, DOFs and named configurations: their numbers, names and indices.

use std::ffi::c_char;

use crate::failure::{Failure, Status, Text, constant, run};
use crate::memory::{at, check, put, put_all, put_numbers, read_text, room};
use crate::robot::Robot;

/// Writes the number of configurations that a person named; 0 without named_configurations_module.
///
/// Errors: `UNUSABLE`: named_configurations_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_num_named_configurations(
    handle: *const Robot,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.configuration_names()?.len()) })
}

/// Writes the name of a named configuration. It lives as long as the robot.
///
/// Errors: `OUT_OF_RANGE`; `UNUSABLE`: named_configurations_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_configuration_name(
    handle: *const Robot,
    index: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe {
        let name = nth("named configuration", at(handle)?.configuration_names()?, index)?;
        put("out", out, name.text())
    })
}

/// Writes a named configuration: `dofs` values, rad or m.
///
/// Errors: `UNKNOWN_NAME`, whose message has the nearest name; `UNUSABLE`: named_configurations_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_named_configuration(
    handle: *const Robot,
    name: *const c_char,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.named_configuration(read_text("name", name)?)?;
        let shape = (1, known.len());
        put_all(("configuration", configuration, dofs), shape, known.iter().copied())
    })
}

/// Writes the number of links, joints and DOFs. Each of the three can be null.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_sizes(
    handle: *const Robot,
    links: *mut usize,
    joints: *mut usize,
    dofs: *mut usize,
) -> Status {
    run(|| unsafe {
        let [of_links, of_joints, of_dofs] = at(handle)?.names()?.each_ref().map(Vec::len);
        put_numbers([
            ("links", links, of_links),
            ("joints", joints, of_joints),
            ("dofs", dofs, of_dofs),
        ])
    })
}

/// Writes the name of a link. It lives as long as the robot.
///
/// Errors: `OUT_OF_RANGE`; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link_name(
    handle: *const Robot,
    link: usize,
    out: *mut Text,
) -> Status {
    unsafe { name(handle, ("link", 0), link, out) }
}

/// As `urdd_robot_link_name`, for a joint.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_joint_name(
    handle: *const Robot,
    joint: usize,
    out: *mut Text,
) -> Status {
    unsafe { name(handle, ("joint", 1), joint, out) }
}

/// As `urdd_robot_link_name`, for a DOF: the name of its joint, with the coordinate if the joint has several.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof_name(
    handle: *const Robot,
    dof: usize,
    out: *mut Text,
) -> Status {
    unsafe { name(handle, ("DOF", 2), dof, out) }
}

/// Writes the unit of a DOF: "rad" or "m". It lives as long as the library.
///
/// Errors: as `urdd_robot_link_name`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof_unit(
    handle: *const Robot,
    dof: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe {
        let text = match *nth("DOF", at(handle)?.robot.dof_units()?, dof)? {
            "m" => constant("m\0"),
            _ => constant("rad\0"),
        };
        put("out", out, text)
    })
}

/// Writes the index of a link.
///
/// Errors: `UNKNOWN_NAME`, whose message has the nearest name; `MISSING_MODULE`, `UNUSABLE`: chain_module or
/// dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.robot.link(read_text("name", name)?)?) })
}

/// As `urdd_robot_link`, for a joint.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_joint(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.robot.joint(read_text("name", name)?)?) })
}

/// Writes the DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
///
/// `dofs` has room for `length` indices, of which the first `found` are written: `found` may be more than `length`, and is
/// at most the number of DOFs.
///
/// Errors: `OUT_OF_RANGE` for a link; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dofs_between(
    handle: *const Robot,
    base: usize,
    tip: usize,
    dofs: *mut usize,
    length: usize,
    found: *mut usize,
) -> Status {
    run(|| unsafe {
        let known = at(handle)?.robot.dofs_between(base, tip)?;
        let out = room("dofs", dofs, length)?;
        for (out, dof) in out.iter_mut().zip(&known) {
            *out = *dof;
        }
        put("found", found, known.len())
    })
}

/// As `urdd_robot_link`, for a DOF.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.robot.dof(read_text("name", name)?)?) })
}

pub(crate) fn out_of_range(what: &'static str, index: usize, count: usize) -> Failure {
    urdd_robot::RobotError::OutOfRange { what, index, count }.into()
}

/// An entry of a list.
pub(crate) fn nth<'a, T>(
    what: &'static str,
    list: &'a [T],
    index: usize,
) -> Result<&'a T, Failure> {
    list.get(index).ok_or_else(|| out_of_range(what, index, list.len()))
}

/// Writes a name of a list of [`Robot::names`].
unsafe fn name(
    handle: *const Robot,
    (what, list): (&'static str, usize),
    index: usize,
    out: *mut Text,
) -> Status {
    run(|| unsafe {
        check("out", out)?;
        put("out", out, nth(what, &at(handle)?.names()?[list], index)?.text())
    })
}
