//! The reports that the page shows.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::{Value, json};

use crate::collection::Collection;
use crate::revision;
use crate::shown::{Shown, Source};
use urdd_directory::root::Root;
use urdd_findings::baseline::Baseline;
use urdd_lint::LintSettings;
use urdd_validate::settings::Settings;
use urdd_validate::settings_file::{SettingsFile, nearest};
use urdd_validate::{Run, report, validate, validate_source};

/// Maximum size of a URDF that is sent with its report, in bytes.
const MAX_TEXT_BYTES: usize = 8 << 20;

/// The report of a robot, created once for each revision: as `urdd validate --format json` prints it, and of a robot
/// that is generated for the page as `urdd lint --format json` prints that of its URDF, with the text and the
/// explanations of rules besides.
pub fn report_of(collection: &Collection, robot: &Shown) -> String {
    let mut known = robot.report.lock();
    let source = robot.source.as_ref().filter(|_| robot.is_temporary());
    let path = robot.path();
    let revision = match source {
        // The URDD is made again when a file changes, and stays when the URDF cannot be read any more.
        Some(source) => {
            let of_urdd = robot.is_ready().then(|| revision::of(&path));
            let project = Project::of(collection, source);
            let files = [Some(&source.file), project.file.as_ref(), project.baseline.as_ref()];
            let files =
                files.map(|file| file.map(|file| revision::of_file(file)).unwrap_or_default());
            Some(format!("{} {}", of_urdd.unwrap_or_default(), files.join(" ")))
        }
        None => robot.open().ok().map(|(revision, _)| revision),
    };
    if let (Some(revision), Some((of, report))) = (&revision, known.as_ref())
        && of == revision
    {
        return report.clone();
    }
    let made = match source {
        Some(source) => report_on_source(collection, source),
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
    made.unwrap_or_else(|error| json!({ "error": error }).to_string())
}

/// The settings for a URDF: those of the nearest `urdd.toml`, unless it was dropped on the page.
#[derive(Default)]
struct Project {
    file: Option<PathBuf>,
    report: Settings,
    baseline: Option<PathBuf>,
    /// What is wrong with the file; the defaults count then.
    fault: Option<String>,
}

impl Project {
    fn of(collection: &Collection, source: &Source) -> Self {
        if collection.has_dropped(&source.file) {
            return Project::default();
        }
        let file = std::path::absolute(&source.file).ok();
        let Some(file) = file.and_then(|file| nearest(file.parent()?)) else {
            return Project::default();
        };
        let (read, fault) = match SettingsFile::read(&file) {
            Ok(read) => (read, None),
            Err(error) => (SettingsFile::default(), Some(error.to_string())),
        };
        Project { file: Some(file), report: read.settings, baseline: read.baseline, fault }
    }
}

/// The report on a URDF, with its text and the settings file that counts for it.
fn report_on_source(collection: &Collection, source: &Source) -> Result<String, String> {
    let all = &collection.settings;
    let mut project = Project::of(collection, source);
    let baseline = project.baseline.as_deref().map(Baseline::read).transpose();
    let baseline = baseline.unwrap_or_else(|error| {
        project.fault = Some(error.to_string());
        None
    });
    let settings = LintSettings {
        report: project.report,
        source: source.with_packages(&all.source),
        baseline: baseline.map(Arc::new),
        ..LintSettings::default()
    };
    let folder = project.file.as_deref().and_then(Path::parent);
    let linted = urdd_lint::lint_with_text(&source.file, &source.arguments, folder, &settings);
    let (run, text) = linted.map_err(|error| error.to_string())?;
    let report: Result<Value, _> = serde_json::from_str(&as_json(&run)?);
    let mut report = report.map_err(|error| error.to_string())?;
    report["rules"] = meanings(&report);
    let shown = project.file.map(|file| file.display().to_string());
    report["settings"] = json!({ "file": shown, "fault": project.fault });
    report["text"] = json!(text.filter(|text| text.len() <= MAX_TEXT_BYTES));
    Ok(report.to_string())
}

/// The report of the URDD at a root. `name` is its name in the report.
pub fn report_on(root: &Root, name: &str) -> Result<String, String> {
    let run = validate_source(root.clone(), name, &Settings::default());
    as_json(&run.map_err(|error| error.to_string())?)
}

fn as_json(run: &Run) -> Result<String, String> {
    report::json(&run.report).map_err(|error| error.to_string())
}

/// The explanations of the rules in a report, where the page's module does not have them.
pub fn meanings(report: &Value) -> Value {
    let findings = report["urdds"][0]["findings"].as_array();
    let codes: BTreeSet<&str> =
        findings.into_iter().flatten().filter_map(|finding| finding["code"].as_str()).collect();
    let of_urdds = urdd_validate::rules::all().into_iter();
    let of_urdfs = urdd_lint::rules::all().into_iter();
    let known =
        of_urdds.map(|rule| &rule.description).chain(of_urdfs.map(|rule| &rule.description));
    let told = known.filter(|rule| codes.contains(&*rule.code.to_string()));
    told.map(|rule| {
        json!({
            "code": rule.code.to_string(),
            "name": rule.name,
            "severity": rule.severity.as_str(),
            "clause": rule.clause,
            "explanation": rule.explanation(),
        })
    })
    .collect()
}
