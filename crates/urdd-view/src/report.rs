//! The reports that the page shows.

use serde_json::{Value, json};

use crate::collection::{Collection, Shown, Source};
use crate::meanings::meanings;
use crate::revision;
use urdd_directory::root::Root;
use urdd_lint::LintSettings;
use urdd_validate::report;
use urdd_validate::settings::Settings;
use urdd_validate::{Run, validate, validate_source};

/// Maximum size of a URDF that is sent with its report, in bytes.
const MAX_TEXT_BYTES: usize = 8 << 20;

/// The report of a robot, created once for each revision: as `urdd validate --format json` prints it, and of a robot
/// that is generated for the page as `urdd lint --format json` prints that of its URDF, with the text and the
/// explanations of rules besides.
pub fn report_of(collection: &Collection, robot: &Shown) -> String {
    let mut known = robot
        .report
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    let source = robot.source.as_ref().filter(|_| robot.is_temporary());
    let path = robot.path();
    let revision = match source {
        // The URDD is made again when a file changes, and stays when the URDF cannot be read any more.
        Some(source) => {
            let of_urdd = robot.is_ready().then(|| revision::of(&path));
            let of_file = revision::of_file(&source.file);
            Some(format!("{} {of_file}", of_urdd.unwrap_or_default()))
        }
        None => robot.open().ok().map(|(revision, _)| revision),
    };
    if let (Some(revision), Some((of, report))) = (&revision, known.as_ref())
        && of == revision
    {
        return report.clone();
    }
    let made = match source {
        Some(source) => report_on_source(source, &collection.settings),
        None => match robot.open() {
            Ok((_, opened)) => {
                let name = path.file_name().unwrap_or_default().to_string_lossy();
                report_on(&opened.all, &name)
            }
            // The report gives the reason.
            Err(_) => validate(&[&path], &Settings::default())
                .map_err(|error| error.to_string())
                .and_then(|run| as_json(&run)),
        },
    };
    if let (Some(revision), Ok(report)) = (revision, &made) {
        *known = Some((revision, report.clone()));
    }
    made.unwrap_or_else(failed)
}

/// The report on a URDF, with its text.
fn report_on_source(source: &Source, all: &urdd_generate::Settings) -> Result<String, String> {
    let settings = LintSettings {
        report: Settings {
            cancellation: all.cancellation.clone(),
            ..Settings::default()
        },
        source: source.settings(all),
        ..LintSettings::default()
    };
    let linted = urdd_lint::lint_with_text(&source.file, &settings);
    let (run, text) = linted.map_err(|error| error.to_string())?;
    let report: Result<Value, _> = serde_json::from_str(&as_json(&run)?);
    let mut report = report.map_err(|error| error.to_string())?;
    report["rules"] = meanings(&report);
    report["text"] = json!(text.filter(|text| text.len() <= MAX_TEXT_BYTES));
    Ok(report.to_string())
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

fn failed(error: String) -> String {
    json!({ "error": error }).to_string()
}
