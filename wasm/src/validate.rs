//! The report of a URDD.

use urdd_format::report::Severity;
use urdd_validate::report::{self};
use urdd_validate::settings::Settings;
use urdd_validate::validate_source;

use crate::files::Files;
use crate::{answer, memory};

/// The report of the URDD in some files, as `urdd validate --format json` prints it. `name` is what the report calls it,
/// UTF-8.
///
/// # Safety
/// `files` is open; the name is the host's, as [`memory::bytes`] wants it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_validate(
    files: *mut Files,
    name: *const u8,
    name_length: usize,
) -> *mut u8 {
    // SAFETY: as the caller promises.
    let (files, name) = unsafe { (&*files, memory::bytes(name, name_length)) };
    match validate(files.clone(), &String::from_utf8_lossy(name)) {
        Ok(report) => answer::text(&report),
        Err(error) => answer::result(Err(error)),
    }
}

fn validate(files: Files, name: &str) -> Result<String, String> {
    let run =
        validate_source(files, name, &Settings::default()).map_err(|error| error.to_string())?;
    report::json(&run.report(Severity::Error)).map_err(|error| error.to_string())
}
