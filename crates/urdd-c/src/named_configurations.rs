//! Configurations that a person named, such as "home".

use std::ffi::c_char;

use crate::failure::{Status, run};
use crate::handle::at;
use crate::memory::{put, put_all, read_text};
use crate::names::nth;
use crate::robot::Robot;
use crate::text::Text;

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
