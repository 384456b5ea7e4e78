//! Validation.

use std::ffi::c_char;

use urdd_format::report::Verdict;
use urdd_validate::Run;
use urdd_validate::report::json;
use urdd_validate::settings::Settings;

use crate::failure::{Failure, Owned, Status, Text, run};
use crate::memory::{at, free, handle, make, put, read_text, values};
use crate::robot::archive;

/// What validation found.
pub struct Report {
    json: Owned,
    passes: bool,
}

handle!(Report, "urdd_report");

impl Report {
    fn of(run: &Run) -> Result<Self, Failure> {
        let text =
            json(&run.report).map_err(|error| Failure::new(Status::Internal, error.to_string()))?;
        let mut urdds = run.report.urdds.iter();
        Ok(Report {
            json: Owned::new(&text),
            passes: urdds.all(|urdd| urdd.verdict == Verdict::Pass),
        })
    }
}

unsafe fn settings_of(settings: *const c_char) -> Result<Settings, Failure> {
    if settings.is_null() {
        return Ok(Settings::default());
    }
    let text = unsafe { read_text("settings", settings) }?;
    Settings::from_toml(text)
        .map_err(|error| Failure::new(Status::Value, format!("settings: {error}")))
}

/// Validates every URDD at or below a path, as `urdd validate` does: a folder, a zip archive, or a folder of them.
///
/// `settings` is the text of a `urdd.toml` (docs/validate.md); null is an empty one. No settings are read from disk.
///
/// Errors: `OPEN` if there is no URDD; `VALUE` for the settings. Findings are no error: the report has them.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_validate(
    path: *const c_char,
    settings: *const c_char,
    out: *mut *mut Report,
) -> Status {
    unsafe {
        make(out, || {
            let (path, settings) = (read_text("path", path)?, settings_of(settings)?);
            Report::of(&urdd_validate::validate(&[path], &settings)?)
        })
    }
}

/// Validates the URDD in a zip archive in memory. `name` is its name in the report.
///
/// Errors: `OPEN` if the bytes are not a zip archive; `VALUE` for the settings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_validate_archive(
    name: *const c_char,
    bytes: *const u8,
    length: usize,
    settings: *const c_char,
    out: *mut *mut Report,
) -> Status {
    unsafe {
        make(out, || {
            let (name, settings) = (read_text("name", name)?, settings_of(settings)?);
            let archive = archive(name, values("bytes", bytes, length)?)?;
            Report::of(&urdd_validate::validate_source(archive, name, &settings)?)
        })
    }
}

/// Writes the report: the JSON of `urdd validate --format json` (schema/report). It lives as long as the report.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_report_json(handle: *const Report, out: *mut Text) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.json.text()) })
}

/// Writes whether every URDD passes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_report_passes(handle: *const Report, out: *mut bool) -> Status {
    run(|| unsafe { put("out", out, at(handle)?.passes) })
}

/// Frees a report. Null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_report_free(report: *mut Report) -> Status {
    unsafe { free(report) }
}
