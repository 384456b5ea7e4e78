//! Links, joints and DOFs: their numbers, names and indices.

use std::ffi::c_char;

use crate::failure::{Failure, Status, run};
use crate::handle::at;
use crate::memory::{check, put, read_text, room};
use crate::robot::{Names, Robot};
use crate::text::{Owned, Text, constant};

/// Writes the number of links, joints and DOFs. Each of the three can be null.
///
/// Errors: `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
///
/// # Safety
/// `handle` is null or open; each of the three is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_sizes(
    handle: *const Robot,
    links: *mut usize,
    joints: *mut usize,
    dofs: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let names = at(handle)?.names()?;
        for (what, out, list) in [
            ("links", links, &names.links),
            ("joints", joints, &names.joints),
            ("dofs", dofs, &names.dofs),
        ] {
            if !out.is_null() {
                put(what, out, list.len())?;
            }
        }
        Ok(())
    })
}

/// Writes the name of a link. It lives as long as the robot.
///
/// Errors: `OUT_OF_RANGE`; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
///
/// # Safety
/// `handle` is null or open; `out` is null or has room for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link_name(
    handle: *const Robot,
    link: usize,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe { name(handle, "link", |names| &names.links, link, out) })
}

/// Writes the name of a joint. It lives as long as the robot.
///
/// Errors: as `urdd_robot_link_name`.
///
/// # Safety
/// As `urdd_robot_link_name`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_joint_name(
    handle: *const Robot,
    joint: usize,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe { name(handle, "joint", |names| &names.joints, joint, out) })
}

/// Writes the name of a DOF: that of its joint, with the coordinate if the joint has several. It lives as long as the
/// robot.
///
/// Errors: as `urdd_robot_link_name`.
///
/// # Safety
/// As `urdd_robot_link_name`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof_name(
    handle: *const Robot,
    dof: usize,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe { name(handle, "DOF", |names| &names.dofs, dof, out) })
}

/// Writes the unit of a DOF: "rad" or "m". It lives as long as the library.
///
/// Errors: as `urdd_robot_link_name`.
///
/// # Safety
/// As `urdd_robot_link_name`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof_unit(
    handle: *const Robot,
    dof: usize,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let units = at(handle)?.robot.dof_units()?;
        let unit = units.get(dof).ok_or_else(|| out_of_range("DOF", dof, units.len()))?;
        let text = match *unit {
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
///
/// # Safety
/// `handle` is null or open; `name` is null or ends with a zero byte; `out` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_link(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let name = read_text("name", name)?;
        put("out", out, at(handle)?.robot.link(name)?)
    })
}

/// Writes the index of a joint.
///
/// Errors: as `urdd_robot_link`.
///
/// # Safety
/// As `urdd_robot_link`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_joint(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let name = read_text("name", name)?;
        put("out", out, at(handle)?.robot.joint(name)?)
    })
}

/// Writes the DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
///
/// `dofs` has room for `length` indices, of which the first `found` are written: `found` may be more than `length`, and is
/// at most the number of DOFs.
///
/// Errors: `OUT_OF_RANGE` for a link; `MISSING_MODULE`, `UNUSABLE`: chain_module or dof_module.
///
/// # Safety
/// `handle` is null or open; there is room for `length` indices at `dofs`; `found` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dofs_between(
    handle: *const Robot,
    base: usize,
    tip: usize,
    dofs: *mut usize,
    length: usize,
    found: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let known = at(handle)?.robot.dofs_between(base, tip)?;
        let out = room("dofs", dofs, length)?;
        for (out, dof) in out.iter_mut().zip(&known) {
            *out = *dof;
        }
        put("found", found, known.len())
    })
}

/// Writes the index of a DOF.
///
/// Errors: as `urdd_robot_link`.
///
/// # Safety
/// As `urdd_robot_link`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_dof(
    handle: *const Robot,
    name: *const c_char,
    out: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let name = read_text("name", name)?;
        put("out", out, at(handle)?.robot.dof(name)?)
    })
}

pub(crate) fn out_of_range(what: &'static str, index: usize, count: usize) -> Failure {
    urdd_robot::RobotError::OutOfRange { what, index, count }.into()
}

/// # Safety
/// As for `urdd_robot_link_name`.
unsafe fn name(
    handle: *const Robot,
    what: &'static str,
    of: impl FnOnce(&Names) -> &[Owned],
    index: usize,
    out: *mut Text,
) -> Result<(), Failure> {
    check("out", out)?;
    // SAFETY: guaranteed by the caller.
    unsafe {
        let names = of(at(handle)?.names()?);
        let name = names.get(index).ok_or_else(|| out_of_range(what, index, names.len()))?;
        put("out", out, name.text())
    }
}
