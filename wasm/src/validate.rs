//! The report of a URDD.

use std::sync::Arc;

use urdd::directory::source::Archive;
use urdd::format::report::Severity;
use urdd::report::{self, model::Report};
use urdd::validate::settings::Settings;
use urdd::validate::validate_source;

use crate::{answer, memory};

/// The report of the URDD in a zip archive, as `urdd validate --format json` prints it. `name` is what the report calls
/// it, UTF-8.
///
/// # Safety
/// Both stretches of bytes are the host's, as [`memory::bytes`] wants them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_validate_zip(
    name: *const u8,
    name_length: usize,
    zip: *const u8,
    zip_length: usize,
) -> *mut u8 {
    // SAFETY: as the caller promises.
    let (name, zip) = unsafe {
        (
            memory::bytes(name, name_length),
            memory::bytes(zip, zip_length),
        )
    };
    match validate(&String::from_utf8_lossy(name), zip) {
        Ok(report) => answer::text(&report),
        Err(error) => answer::result(Err(error)),
    }
}

fn validate(name: &str, zip: &[u8]) -> Result<String, String> {
    let source = Archive::new(name, Arc::from(zip)).map_err(|error| error.to_string())?;
    let run =
        validate_source(source, name, &Settings::default()).map_err(|error| error.to_string())?;
    report::json(&Report::new(&run, Severity::Error)).map_err(|error| error.to_string())
}
