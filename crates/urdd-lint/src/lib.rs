//! Internal to urdd; no stability promise.
//!
//! What is odd about a URDF, for those who write one: the rules LNT, and those of the validator that need only the
//! source. The rules are about robots, not about URDDs: they are described in docs/lint.md, and may change with every
//! version. [`lint`] examines files, [`lint_text`] a text that an editor holds.

// Hidden modules are public for `tests/`.
#[doc(hidden)]
pub mod allow;
mod bodies;
mod effects;
mod elements;
mod examine;
mod fix;
mod geometry;
#[doc(hidden)]
pub mod hull;
mod imports;
#[doc(hidden)]
pub mod inertial;
mod named_file;
mod namespaces;
pub mod pose;
#[doc(hidden)]
pub mod primitives;
mod programs;
mod rule;
pub mod rules;
mod settings;
pub mod skip;
mod srdf;
mod subject;
mod target;
mod textures;
mod unknown;
pub mod vocabulary;
#[doc(hidden)]
pub mod written;

pub use fix::{ChangedError, Mended, mend};
pub use rule::LintRule;
pub use settings::LintSettings;
pub use target::LeftAlone;

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use thiserror::Error;

use examine::examined;
use urdd_directory::cancellation::Cancelled;
use urdd_findings::examined::Examined;
use urdd_findings::run::Run;
use urdd_format::report::{Kind, StaleIgnore};
use urdd_source::import::import;
use urdd_source::robots::{BatchError, jobs};
use urdd_source::{SourceError, SourceText, included, read_source};
use written::{Sources, say_where};

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
    let linted = files.par_iter().map(|path| lint_file(path, paths, settings)).collect();
    settings.report.cancellation.check()?;
    Ok(run_of(&files, linted, excluded, settings))
}

/// Lints a URDF or xacro file. Patterns of the settings match its path from the folder `seen_from`, or its name. Returns
/// also the text that lines refer to, which is the expanded one of a xacro file; `None` if the file cannot be read.
///
/// # Errors
/// If the run is cancelled.
pub fn lint_with_text(
    path: &Path,
    seen_from: Option<&Path>,
    settings: &LintSettings,
) -> Result<(Run, Option<String>), Cancelled> {
    let paths = [path.to_owned()];
    let from = seen_from.map_or_else(|| paths.to_vec(), |folder| vec![folder.to_owned()]);
    let mut linted = lint_file(path, &from, settings);
    settings.report.cancellation.check()?;
    let text = linted.text.take();
    Ok((run_of(&paths, vec![linted], 0, settings), text))
}

/// What was found in a file.
struct Linted {
    examined: Examined,
    /// Ignores and comments that matched nothing.
    stale: Vec<StaleIgnore>,
    /// What was examined.
    text: Option<String>,
}

fn run_of(files: &[PathBuf], linted: Vec<Linted>, excluded: usize, settings: &LintSettings) -> Run {
    let folders = files.iter().map(|path| stems(path).0).collect();
    let linted = linted.into_iter().map(|one| (one.examined, one.stale));
    let (examined, stale): (Vec<Examined>, Vec<Vec<StaleIgnore>>) = linted.unzip();
    let mut run = Run::of(examined, folders, excluded, &settings.report);
    run.report.stale_ignores.extend(stale.into_iter().flatten());
    run
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
        !settings.report.excludes.iter().any(|exclude| exclude.matches(&seen))
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

/// The path that patterns of settings match: that of a file from the folder that was given, with forward slashes; its own
/// name where the file itself was given, or is in no such folder.
pub fn seen_from(path: &Path, given: &[PathBuf]) -> String {
    let inside = given.iter().find_map(|given| path.strip_prefix(given).ok());
    match inside.filter(|inside| !inside.as_os_str().is_empty()) {
        Some(inside) => inside.to_string_lossy().replace('\\', "/"),
        None => stems(path).1,
    }
}

fn lint_file(path: &Path, given: &[PathBuf], settings: &LintSettings) -> Linted {
    let seen = seen_from(path, given);
    let (mut stale, mut text) = (Vec::new(), None);
    let mut examined = Examined::caught::<SourceError>(Kind::Urdf, &seen, || {
        let (mut examined, unused) = match import(path, &settings.source)? {
            Some(imported) => {
                let found = imports::examined_import(&imported, stems(path), settings)?;
                text = Some(imported.original);
                found
            }
            None => {
                let read = read_source(path, &settings.source, &settings.report.cancellation)?;
                let found = of_source(path, &read, settings);
                text = Some(read.text);
                found
            }
        };
        stale.extend(unused);
        if let Some(baseline) = &settings.baseline {
            stale.extend(baseline.apply(path, &mut examined));
        }
        Ok(examined)
    });
    examined.report.path = seen;
    Linted { examined, stale, text }
}

/// Lints the text of a file as [`read_source`] gives it. Where xacro made the text, places also say where links and joints
/// are written. Of the settings, only those that change what the rules compute apply here.
pub fn lint_source(path: &Path, read: &SourceText, settings: &LintSettings) -> Examined {
    of_source(path, read, settings).0
}

fn of_source(
    path: &Path,
    read: &SourceText,
    settings: &LintSettings,
) -> (Examined, Vec<StaleIgnore>) {
    let name = stems(path).1;
    let (mut examined, unused) = examined(&read.text, read.bytes(), &name, &read.folder, settings);
    let mut checks = examined.checks.iter();
    if read.is_expanded && checks.any(|check| !check.findings.is_empty()) {
        let mut files = included(path, &settings.source, &settings.report.cancellation);
        files.extend(path.canonicalize());
        let sources = Sources::read(&files, &read.folder);
        say_where(&mut examined.checks, |subject| sources.find(subject).cloned());
    }
    (examined, unused)
}

/// Lints a text. `name` is its file's name in the report; relative mesh names refer to `folder`. Of the settings, only
/// those that change what the rules compute apply here.
pub fn lint_text(text: &str, name: &str, folder: &Path, settings: &LintSettings) -> Examined {
    examined(text, text.as_bytes(), name, folder, settings).0
}
