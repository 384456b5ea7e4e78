//! The report of a URDD.

use urdd_validate::report;
use urdd_validate::settings::Settings;
use urdd_validate::validate_source;

use crate::files::Files;
use crate::{answer, memory};

/// The report on the URDD in these files, as `urdd validate --format json` prints it. `name` is its name in the report,
/// in UTF-8.
///
/// # Safety
/// `files` is open; the name is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_validate(
    files: *mut Files,
    name: *const u8,
    name_length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, name) = unsafe { (&*files, memory::bytes(name, name_length)) };
    match validate(files.clone(), &String::from_utf8_lossy(name)) {
        Ok(report) => answer::text(&report),
        Err(error) => answer::result(Err(error)),
    }
}

fn validate(files: Files, name: &str) -> Result<String, String> {
    let run =
        validate_source(files, name, &Settings::default()).map_err(|error| error.to_string())?;
    report::json(&run.report).map_err(|error| error.to_string())
}
