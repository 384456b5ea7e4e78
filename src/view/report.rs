//! The reports that the page shows.

use serde_json::json;

use super::collection::Shown;
use urdd_directory::root::Root;
use urdd_validate::report;
use urdd_validate::settings::Settings;
use urdd_validate::{Run, validate, validate_source};

/// The report of a robot, as `urdd validate --format json` prints it. Created once for each revision.
///
/// This is the only place where the report of a robot is made for the page, the gallery and an export. Findings on
/// what the robot is generated from ([`Shown::source`]), as `urdd lint` has them, are to be merged here.
pub fn report_of(robot: &Shown) -> String {
    let mut known = robot
        .report
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let path = robot.path();
    let made = match robot.open() {
        Ok((revision, opened)) => {
            if let Some((of, report)) = known.as_ref()
                && *of == revision
            {
                return report.clone();
            }
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let made = report_on(&opened.all, &name);
            if let Ok(report) = &made {
                *known = Some((revision, report.clone()));
            }
            made
        }
        // The report gives the reason.
        Err(_) => validate(&[&path], &Settings::default())
            .map_err(|error| error.to_string())
            .and_then(|run| as_json(&run)),
    };
    made.unwrap_or_else(|error| json!({ "error": error }).to_string())
}

/// The report of the URDD at a root. `name` is its name in the report.
///
/// # Errors
/// If there is no report.
pub fn report_on(root: &Root, name: &str) -> Result<String, String> {
    let run = validate_source(root.clone(), name, &Settings::default());
    as_json(&run.map_err(|error| error.to_string())?)
}

fn as_json(run: &Run) -> Result<String, String> {
    report::json(&run.report).map_err(|error| error.to_string())
}
