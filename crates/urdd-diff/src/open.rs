//! Opens a robot of either kind, and validates it.

use std::path::Path;

use crate::side::{DiffError, Options, Side};
use crate::{side_urdd, side_urdf};
use urdd_directory::discover::{Found, discover};
use urdd_format::report;
use urdd_validate::settings::Settings;
use urdd_validate::{ValidateError, validate};

impl Side {
    /// Opens a URDF (a file whose name ends in `.urdf`), or a URDD: a folder or a zip archive.
    ///
    /// # Errors
    /// If the path has no robot, or one that cannot be read.
    pub fn open(path: &Path, options: &Options) -> Result<Side, DiffError> {
        let shown = path.display().to_string();
        let extension = path.extension().unwrap_or_default();
        let is_urdf = extension.eq_ignore_ascii_case("urdf") && !path.is_dir();
        if is_urdf && path.exists() {
            let mut side = side_urdf::open(path, shown, options)?;
            side.validation = validation(path, options)?;
            return Ok(side);
        }
        let found = discover(path).map_err(DiffError::Discover)?;
        let found = match found.as_slice() {
            [one] => one,
            several => {
                let first = several.first().map(|found| found.path.display().to_string());
                return Err(DiffError::Several {
                    path: shown,
                    count: several.len(),
                    first: first.unwrap_or_default(),
                });
            }
        };
        let Found { path, closed, .. } = found;
        if let Some(error) = closed {
            let reason = error.to_string();
            return Err(DiffError::NoRobot { path: shown, reason });
        }
        let mut side = side_urdd::open(path, shown)?;
        side.validation = validation(path, options)?;
        Ok(side)
    }
}

fn validation(path: &Path, options: &Options) -> Result<Option<report::Urdd>, DiffError> {
    if options.without_findings {
        return Ok(None);
    }
    let settings =
        Settings { cancellation: options.urdf.cancellation.clone(), ..Settings::default() };
    let run = validate(&[path], &settings).map_err(|error| match error {
        ValidateError::Discover(error) => DiffError::Discover(error),
        _ => DiffError::Cancelled,
    })?;
    Ok(run.report.urdds.into_iter().next())
}
