//! Internal to urdd; no stability promise.
//!
//! What is odd about a URDF, for those who write one: the rules LNT, and those of the validator that need only the
//! source. The rules are about robots, not about URDDs: they are described in docs/lint.md, and may change with every
//! version. [`lint`] examines files, [`lint_text`] a text that an editor holds.

mod allow;
mod baseline;
mod bodies;
mod elements;
mod fix;
mod geometry;
mod hull;
mod inertial;
mod named_file;
mod places;
mod pose;
mod primitives;
mod rule;
pub mod rules;
mod srdf;
mod subject;
mod unknown;
mod vocabulary;
mod written;

pub use baseline::{Baseline, BaselineError};
pub use fix::{ChangedError, Mended, mend};
pub use rule::LintRule;

use std::borrow::Cow;
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
use urdd_format::index::Count;
use urdd_format::report::{Kind, Place, StaleIgnore, Verdict};
use urdd_generate::batch::{BatchError, jobs};
use urdd_generate::{SourceMeshes, included, open_source_text, read_source, well_formed};
use urdd_validate::code::Code;
use urdd_validate::engine::caught;
use urdd_validate::finding::{Finding, Findings};
use urdd_validate::selection::Codes;
use urdd_validate::settings::Settings;
use urdd_validate::{Examined, Run};
use written::Sources;

/// How URDFs are linted.
#[derive(Debug, Clone, Default)]
pub struct LintSettings {
    /// What is reported, and how severe it is.
    pub report: Settings,
    /// Where packages and meshes are, and how xacro files are expanded.
    pub source: urdd_generate::Settings,
    /// What was found before, and is not reported.
    pub baseline: Option<Baseline>,
    /// Whether no mesh file is read, as while somebody types: rules about the shapes of links are skipped.
    pub without_meshes: bool,
}

/// Why a run has no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LintError {
    /// One of the paths has nothing to examine.
    #[error(transparent)]
    Batch(#[from] BatchError),
    /// Folders with nothing but xacro files.
    #[error("there are only xacro files, which are programs: --xacro expands those in folders")]
    OnlyXacro,
    /// Cancelled through the settings.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Lints URDFs, xacro files, and all of them below folders, in parallel.
///
/// # Errors
/// If a path has nothing to examine, or the run is cancelled.
pub fn lint(paths: &[PathBuf], settings: &LintSettings) -> Result<Run, LintError> {
    let (files, excluded) = sources(paths, settings)?;
    let linted = files
        .par_iter()
        .map(|path| lint_file(path, paths, settings));
    let (examined, stale): (Vec<Examined>, Vec<Vec<StaleIgnore>>) = linted.unzip();
    settings.report.cancellation.check()?;
    let folders = files.iter().map(|path| stems(path).0).collect();
    let mut run = Run::of(examined, folders, excluded, &settings.report);
    run.report.stale_ignores.extend(stale.into_iter().flatten());
    Ok(run)
}

/// The files to lint, and the number of those that the settings exclude.
fn sources(paths: &[PathBuf], settings: &LintSettings) -> Result<(Vec<PathBuf>, usize), LintError> {
    let mut files: Vec<PathBuf> = jobs(paths)?.into_iter().map(|job| job.source).collect();
    // A xacro file is a program: it runs where somebody names it, or asks for xacro.
    let found = files.len();
    let is_named = |file: &PathBuf| paths.contains(file) || settings.source.xacro.expand_urdf;
    files.retain(|file| is_named(file) || file.extension().is_none_or(|end| end != "xacro"));
    if files.is_empty() && found > 0 {
        return Err(LintError::OnlyXacro);
    }
    let all = files.len();
    files.retain(|path| {
        let seen = seen_from(path, paths);
        !settings
            .report
            .excludes
            .iter()
            .any(|exclude| exclude.matches(&seen))
    });
    let excluded = all - files.len();
    Ok((files, excluded))
}

/// The folder and the name of a file.
fn stems(path: &Path) -> (PathBuf, String) {
    let name = path.file_name().unwrap_or_default();
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    (folder.to_owned(), name.to_string_lossy().into_owned())
}

/// The path of a file from the path that was given; its own name where that is the file.
fn seen_from(path: &Path, given: &[PathBuf]) -> String {
    let inside = given.iter().find_map(|given| path.strip_prefix(given).ok());
    match inside.filter(|inside| !inside.as_os_str().is_empty()) {
        Some(inside) => inside.to_string_lossy().replace('\\', "/"),
        None => stems(path).1,
    }
}

fn lint_file(
    path: &Path,
    given: &[PathBuf],
    settings: &LintSettings,
) -> (Examined, Vec<StaleIgnore>) {
    let (seen, name) = (seen_from(path, given), stems(path).1);
    let mut stale = Vec::new();
    let mut examined = urdd_validate::caught(Kind::Urdf, &seen, || {
        let read = match read_source(path, &settings.source) {
            Ok(read) => read,
            Err(error) => return Ok(unreadable(&name, error.to_string())),
        };
        let (mut examined, unused) = examined(&read.text, &name, &read.folder, settings);
        if read.is_expanded
            && examined
                .checks
                .iter()
                .any(|check| !check.findings.is_empty())
        {
            let mut files = included(path, &settings.source);
            files.extend(path.canonicalize());
            Sources::read(&files, &read.folder).place(&mut examined.checks);
        }
        stale.extend(unused);
        if let Some(baseline) = &settings.baseline {
            stale.extend(baseline.apply(path, &mut examined));
        }
        Ok(examined)
    });
    examined.report.path = seen;
    (examined, stale)
}

fn unreadable(name: &str, reason: String) -> Examined {
    let mut report = urdd_validate::report::blank(Kind::Urdf, name);
    (report.verdict, report.reason) = (Verdict::Unreadable, Some(reason));
    Examined {
        report,
        checks: Vec::new(),
    }
}

/// Lints a text. `name` is its file's name in the report; relative mesh names refer to `folder`. Of the settings, only
/// those that change what the rules compute apply here.
pub fn lint_text(text: &str, name: &str, folder: &Path, settings: &LintSettings) -> Examined {
    examined(text, name, folder, settings).0
}

/// The result, and the comments that allow what was not found.
fn examined(
    text: &str,
    name: &str,
    folder: &Path,
    settings: &LintSettings,
) -> (Examined, Vec<StaleIgnore>) {
    let mut examined = by_validator(text, name);
    // URD011 says what is wrong; the rest can be looked at nevertheless.
    let (mended, lines) = match urdd_xml::parse(text, urdd_xml::Kind::Robot) {
        Ok(_) => (Cow::Borrowed(text), 0),
        Err(_) => {
            let (mended, lines) = well_formed(text);
            (Cow::Owned(mended), lines)
        }
    };
    let Ok(document) = urdd_xml::parse(&mended, urdd_xml::Kind::Robot) else {
        return (examined, Vec::new());
    };
    let source: Option<SourceMeshes> = open_source_text(text, name, folder, &settings.source).ok();
    let subject = Subject::new(name, folder, &document, source.as_ref());
    let subject = subject.without_meshes(settings.without_meshes);
    let report = &settings.report;
    let runs = |rule: &LintRule| {
        let code = rule.description.code;
        let select = &report.selection.select;
        let is_selected = select.is_empty() || select.iter().any(|codes| codes.holds(code));
        let is_named = select.contains(&Codes::One(code)) || report.severities.contains_key(&code);
        is_selected && (rule.on_by_default || is_named)
    };
    let is_macro = subject.macros().is_some();
    let applies = |rule: &&LintRule| !is_macro || rule.description.code == Code::LNT051;
    if is_macro {
        // LNT051 says it all.
        examined.checks.clear();
    }
    for rule in rules::all()
        .into_iter()
        .filter(|rule| runs(rule))
        .filter(applies)
    {
        if settings.report.cancellation.is_cancelled() {
            break;
        }
        let mut check = caught(&rule.description, &mut Findings::default(), |findings| {
            (rule.check)(&subject, findings)
        });
        let is_mended = matches!(mended, Cow::Owned(_));
        for place in check.findings.iter_mut().flat_map(places) {
            as_reported(place, lines, is_mended);
        }
        examined.checks.push(check);
    }
    let stale = allow::apply(&document, name, &mut examined.checks);
    (examined, stale)
}

/// All places of a finding.
fn places(finding: &mut Finding) -> impl Iterator<Item = &mut Place> {
    std::iter::once(&mut finding.place).chain(&mut finding.more)
}

/// The pointers that findings are folded by are no pointers into a document. In a text that was mended, lines at the
/// beginning are missing, and fixes would not fit.
fn as_reported(place: &mut Place, lines: u32, is_mended: bool) {
    place.pointer = None;
    place.line = place.line.map(|line| Count(line.0 + lines));
    if is_mended {
        place.fixes.clear();
    }
    for related in &mut place.related {
        as_reported(related, lines, is_mended);
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
    for place in places(finding) {
        let related = place.related.iter_mut().map(|place| &mut place.file);
        let edits = place.fixes.iter_mut().flat_map(|fix| &mut fix.edits);
        edits.for_each(|edit| edit.file = name.to_owned());
        for file in related.chain([&mut place.file]).flatten() {
            *file = name.to_owned();
        }
    }
}
