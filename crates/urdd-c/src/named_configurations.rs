//! Configurations that a person named, such as "home".

use std::ffi::c_char;

use crate::failure::{Status, run};
use crate::handle::at;
use crate::memory::{exact_room, put, read_text};
use crate::names::out_of_range;
use crate::robot::Robot;
use crate::text::Text;

/// Writes the number of configurations that a person named; 0 without named_configurations_module.
///
/// Errors: `UNUSABLE`: named_configurations_module.
///
/// # Safety
/// `handle` is null or open; `out` is null or has room for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_num_named_configurations(
    handle: *const Robot,
    out: *mut usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe { put("out", out, at(handle)?.configuration_names()?.len()) })
}

/// Writes the name of a named configuration. It lives as long as the robot.
///
/// Errors: `OUT_OF_RANGE`; `UNUSABLE`: named_configurations_module.
///
/// # Safety
/// `handle` is null or open; `out` is null or has room for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_configuration_name(
    handle: *const Robot,
    index: usize,
    out: *mut Text,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let names = at(handle)?.configuration_names()?;
        let what = "named configuration";
        let name = names.get(index).ok_or_else(|| out_of_range(what, index, names.len()))?;
        put("out", out, name.text())
    })
}

/// Writes a named configuration: `dofs` values, rad or m.
///
/// Errors: `UNKNOWN_NAME`, whose message has the nearest name; `LENGTH`; `UNUSABLE`: named_configurations_module.
///
/// # Safety
/// `handle` is null or open; `name` is null or ends with a zero byte; there is room for `dofs` values at
/// `configuration`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_robot_named_configuration(
    handle: *const Robot,
    name: *const c_char,
    configuration: *mut f64,
    dofs: usize,
) -> Status {
    // SAFETY: guaranteed by the caller.
    run(|| unsafe {
        let known = at(handle)?.robot.named_configuration(read_text("name", name)?)?;
        let out = exact_room("configuration", configuration, dofs, (1, known.len()))?;
        out.copy_from_slice(known);
        Ok(())
    })
}
