//! Internal to urdd; no stability promise.
//!
//! What is odd about a URDF, for those who write one: the rules LNT, and those of the validator that need only the
//! source. The rules are about robots, not about URDDs: they are described in docs/lint.md, and may change with every
//! version. [`lint`] examines files, [`lint_text`] a text that an editor holds.

mod geometry;
mod inertial;
mod rule;
pub mod rules;
mod subject;

pub use rule::LintRule;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;
use thiserror::Error;

use subject::Subject;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::read_error::ReadError;
use urdd_directory::root::Root;
use urdd_directory::source::Memory;
use urdd_format::report::{Kind, Verdict};
use urdd_generate::batch::{BatchError, jobs};
use urdd_generate::{SourceMeshes, open_source_text, read_source};
use urdd_validate::engine::caught;
use urdd_validate::finding::{Finding, Findings};
use urdd_validate::selection::Codes;
use urdd_validate::settings::Settings;
use urdd_validate::{Examined, Run};

/// How URDFs are linted.
#[derive(Debug, Clone, Default)]
pub struct LintSettings {
    /// What is reported, and how severe it is.
    pub report: Settings,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_generate::Settings,
}

/// Why a run has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LintError {
    /// One of the paths has nothing to examine.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// Cancelled through the settings.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Lints URDFs, xacro files, and all of them below folders, in parallel.
///
/// # Errors
/// If a path has nothing to examine, or the run is cancelled.
pub fn lint(paths: &[PathBuf], settings: &LintSettings) -> Result<Run, LintError> {
    let jobs = jobs(paths)?;
    let all = jobs.len();
    let files: Vec<PathBuf> = jobs.into_iter().map(|job| job.source).collect();
    let shown = |path: &Path| path.to_string_lossy().replace('\\', "/");
    let files: Vec<PathBuf> = files
        .into_iter()
        .filter(|path| {
            let mut excludes = settings.report.excludes.iter();
            !excludes.any(|exclude| exclude.matches(&shown(path)))
        })
        .collect();
    let examined = files.par_iter().map(|path| {
        let name = file_name(path);
        urdd_validate::caught(Kind::Urdf, &name, || Ok(lint_file(path, &name, settings)))
    });
    let examined: Vec<Examined> = examined.collect();
    settings.report.cancellation.check()?;
    let folders = files.iter().map(|path| folder_of(path));
    let folders = folders.collect();
    Ok(Run::of(
        examined,
        folders,
        all - files.len(),
        &settings.report,
    ))
}

fn file_name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

fn lint_file(path: &Path, name: &str, settings: &LintSettings) -> Examined {
    let read = match read_source(path, &settings.source) {
        Ok(read) => read,
        Err(error) => {
            let mut report = urdd_validate::report::blank(Kind::Urdf, name);
            (report.verdict, report.reason) = (Verdict::Unreadable, Some(error.to_string()));
            return Examined {
                report,
                checks: Vec::new(),
            };
        }
    };
    lint_text(&read.text, name, &read.folder, settings)
}

/// Lints a text. `name` is its file's name in the report; relative mesh names refer to `folder`. Of the settings, only
/// those that change what the rules compute apply here.
pub fn lint_text(text: &str, name: &str, folder: &Path, settings: &LintSettings) -> Examined {
    let mut examined = by_validator(text, name);
    let Ok(document) = urdd_xml::parse(text, urdd_xml::Kind::Robot) else {
        return examined;
    };
    let source: Option<SourceMeshes> = open_source_text(text, name, folder, &settings.source).ok();
    let subject = Subject::new(name, folder, &document, source.as_ref());
    let report = &settings.report;
    let runs = |rule: &LintRule| {
        let code = rule.description.code;
        rule.on_by_default
            || report.selection.select.contains(&Codes::One(code))
            || report.severities.contains_key(&code)
    };
    for rule in rules::all().into_iter().filter(|rule| runs(rule)) {
        if settings.report.cancellation.is_cancelled() {
            break;
        }
        let mut check = caught(&rule.description, &mut Findings::default(), |findings| {
            (rule.check)(&subject, findings)
        });
        check.findings.iter_mut().for_each(without_pointers);
        examined.checks.push(check);
    }
    examined
}

/// The pointers that findings are folded by are no pointers into a document.
fn without_pointers(finding: &mut Finding) {
    for place in std::iter::once(&mut finding.place).chain(&mut finding.more) {
        place.pointer = None;
        for related in &mut place.related {
            related.pointer = None;
        }
    }
}

/// What the validator says of the URDF alone.
fn by_validator(text: &str, name: &str) -> Examined {
    urdd_validate::caught(Kind::Urdf, name, || {
        let bytes: Arc<[u8]> = Arc::from(text.as_bytes());
        // Its own name could be one that no URDD may hold.
        const FILE: &str = "robot.urdf";
        let memory = Memory::new(name, BTreeMap::from([(FILE.to_owned(), bytes)]));
        let memory = memory.map_err(|_| ReadError::Missing)?;
        let mut examined = urdd_validate::bare_urdf::examine_file(
            Root::of(memory),
            FILE,
            &urdd_validate::rules::all(),
        )?;
        examined.report.path = name.to_owned();
        for finding in examined
            .checks
            .iter_mut()
            .flat_map(|check| &mut check.findings)
        {
            renamed(finding, name);
        }
        Ok(examined)
    })
}

fn renamed(finding: &mut Finding, name: &str) {
    for place in std::iter::once(&mut finding.place).chain(&mut finding.more) {
        let related = place.related.iter_mut().map(|place| &mut place.file);
        let edits = place.fixes.iter_mut().flat_map(|fix| &mut fix.edits);
        edits.for_each(|edit| edit.file = name.to_owned());
        for file in related.chain([&mut place.file]).flatten() {
            *file = name.to_owned();
        }
    }
}
