//! The report of a description.

use std::path::Path;

use serde::Deserialize;
use serde_json::Value;
use urdd_directory::file_type::FileType;
use urdd_findings::report;
use urdd_findings::settings::parse_program;
use urdd_lint::{LintSettings, lint_with_text};

use crate::around::GivenFiles;
use crate::explain::explained;
use crate::files::Files;
use crate::{answer, memory};

/// What is asked.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    /// The path of the URDF, MJCF, SDF or USD; it may be left out where there is one URDF alone.
    urdf: Option<String>,
    /// The programs that it is for.
    #[serde(default, rename = "for")]
    programs: Vec<String>,
    /// Whether the report also has the `text` that lines refer to, and the `rules` of its findings.
    #[serde(default)]
    with_text: bool,
}

/// The report on a URDF among these files, as `urdd lint --format json` prints it. The question is a [`Question`] as JSON.
///
/// # Safety
/// `files` is open; the question is valid for [`memory::bytes`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn urdd_lint(
    files: *mut Files,
    question: *const u8,
    length: usize,
) -> *mut u8 {
    // SAFETY: guaranteed by the caller.
    let (files, question) = unsafe { (&*files, memory::bytes(question, length)) };
    match lint(files, question) {
        Ok(report) => answer::text(&report),
        Err(error) => answer::result(Err(error)),
    }
}

fn lint(files: &Files, question: &[u8]) -> Result<String, String> {
    let question: Question = serde_json::from_slice(question).map_err(|error| error.to_string())?;
    let given = GivenFiles::of(files)?;
    let path = urdf(given.paths(), question.urdf)?;
    let mut settings = LintSettings { source: given.settings(&path)?, ..LintSettings::default() };
    for name in &question.programs {
        let known = parse_program(name).map_err(|error| error.to_string())?;
        settings.report.programs.push(known);
    }
    let linted = lint_with_text(&given.place(&path), &[], None, &settings);
    let (run, text) = linted.map_err(|error| error.to_string())?;
    let report = report::json(&run.report).map_err(|error| error.to_string())?;
    if !question.with_text {
        return Ok(report);
    }
    let mut report: Value = serde_json::from_str(&report).map_err(|error| error.to_string())?;
    let findings = run.report.urdds.iter().flat_map(|urdd| &urdd.findings);
    let codes: std::collections::BTreeSet<&str> = findings.map(|found| &*found.code).collect();
    report["rules"] = codes.into_iter().filter_map(explained).collect();
    report["text"] = text.into();
    Ok(report.to_string())
}

/// The URDF that is asked about, or the only one.
fn urdf(paths: &[String], asked: Option<String>) -> Result<String, String> {
    if let Some(asked) = asked {
        return Ok(asked);
    }
    let mut urdfs = paths.iter().filter(|path| FileType::Urdf.is_of(Path::new(path)));
    match (urdfs.next(), urdfs.next()) {
        (Some(only), None) => Ok(only.clone()),
        (None, _) => Err("there is no .urdf among the files".to_owned()),
        (Some(first), Some(second)) => Err(format!(
            "there are several URDFs, such as `{}` and `{}`: name one as `urdf`",
            first.escape_debug(),
            second.escape_debug()
        )),
    }
}
