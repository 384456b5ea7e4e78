//! Internal to urdd; no stability promise.
//!
//! What is odd about a URDF, for those who write one: the rules LNT, and those of the validator that need only the
//! source. The rules are about robots, not about URDDs: they are described in docs/lint.md, and may change with every
//! version. [`lint`] examines files, [`lint_text`] a text that an editor holds.

// Hidden modules are public for `tests/`.
mod beside;
mod examine;
mod fix;
mod fixes;
mod geometry;
#[doc(hidden)]
pub mod hull;
mod in_programs;
pub mod pose;
mod programs;
pub mod rules;
pub mod settings;
mod sources;
mod srdf;
mod subject;
#[doc(hidden)]
pub mod told;
pub mod vocabulary;
mod written;

pub use fix::{ChangedError, LeftAlone, Mended, mend};
pub use rules::prelude::LintRule;
pub use settings::{LintSettings, declared};
pub use sources::{LintError, Undeclared, lint_undeclared, seen_from, undeclared};

use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::watched::{map_robots, watched};
use urdd_findings::answer;
use urdd_findings::check::Examined;
use urdd_findings::run::Run;
use urdd_format::index::Count;
use urdd_format::report::{
    Cause, ImportedFrom, ImportedPart, Kind, NotExamined, StaleIgnore, WrittenAt,
};
use urdd_import::{Imported, import};
use urdd_source::macros::{has_no_link, has_no_name, has_open_ends};
use urdd_source::robots::Job;
use urdd_source::{Files, MAX_SOURCE_BYTES, SourceError, SourceText, read_source};
use urdd_xml::Xml;

use examine::examined;
use sources::{Sources, sources, stems};
use written::{named, say_where, say_where_expanded};

/// Lints URDFs, xacro files, and all of them below folders, in parallel.
///
/// # Errors
/// If a path has nothing to examine, or the run is cancelled.
pub fn lint(paths: &[PathBuf], settings: &LintSettings) -> Result<Run, LintError> {
    let Sources { jobs, excluded, batch } = sources(paths, settings)?;
    let is_found = |job: &Job| match batch.may_drop(&job.source) {
        true if batch.description.may_be_part(&job.source) => Found::Included,
        true => Found::InFolder,
        false => Found::Named,
    };
    let run = &settings.source.cancellation;
    let given: Arc<[PathBuf]> = paths.into();
    let lint = |job: &Job| {
        let seen = seen_from(&job.source, &given);
        let (own, found, given) = (job.clone(), is_found(job), Arc::clone(&given));
        let mut settings = settings.clone();
        let work = move |cancellation: &Cancellation| {
            settings.source.cancellation = cancellation.clone();
            lint_file(&own, found, &given, &settings)
        };
        watched(run, &seen, work).unwrap_or_else(|limit| {
            let examined = Examined::without_checks(Kind::Urdf, &seen, answer::beyond(limit));
            Some(Linted { examined, stale: Vec::new(), text: None })
        })
    };
    let linted = map_robots(run, &jobs, lint);
    run.check()?;
    let parts = linted.iter().filter(|one| one.is_none()).count();
    let linted = jobs.into_iter().zip(linted).filter_map(|(job, one)| Some((job.source, one?)));
    let (files, linted): (Vec<PathBuf>, Vec<Linted>) = linted.unzip();
    let mut run = run_of(&files, linted, excluded, settings);
    run.asides = batch.asides(parts);
    Ok(run)
}

/// Lints a URDF or xacro file, with the arguments for xacro that are declared of it. Patterns of the settings match its path
/// from the folder `seen_from`, or its name. Returns also the file's text; `None` if it cannot be read.
///
/// # Errors
/// If the run is cancelled.
pub fn lint_with_text(
    path: &Path,
    declared: &[String],
    seen_from: Option<&Path>,
    settings: &LintSettings,
) -> Result<(Run, Option<String>), Cancelled> {
    let paths = [path.to_owned()];
    let from = seen_from.map_or_else(|| paths.to_vec(), |folder| vec![folder.to_owned()]);
    let arguments = declared.to_vec();
    let job = Job { arguments, ..Job::new(path.to_owned(), String::new()) };
    let mut linted = lint_file(&job, Found::Named, &from, settings);
    settings.source.cancellation.check()?;
    let text = linted.as_mut().and_then(|linted| linted.text.take());
    let text = text.or_else(|| as_written(path, &settings.source.files));
    Ok((run_of(&paths, Vec::from_iter(linted), 0, settings), text))
}

struct Linted {
    examined: Examined,
    /// Ignores and comments that matched nothing.
    stale: Vec<StaleIgnore>,
    /// The text of the file, where that is what was examined.
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

/// How a file came to be examined.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Found {
    /// A person names it, or declares it: it is to be a robot.
    Named,
    /// It is in a folder.
    InFolder,
    /// It is in a folder, and another file there includes it.
    Included,
}

/// Lints a file; `None` for one that turns out to be a part of robots: its expansion has no link; or another file includes it,
/// and it has no expansion by itself, or one without a name for the robot, or one that is no whole tree.
fn lint_file(
    job: &Job,
    found: Found,
    given: &[PathBuf],
    settings: &LintSettings,
) -> Option<Linted> {
    let settings = &LintSettings { source: job.settings(&settings.source), ..settings.clone() };
    let path = job.source.as_path();
    let seen = seen_from(path, given);
    let (mut stale, mut text, mut is_part) = (Vec::new(), None, false);
    let mut examine = || -> Result<Examined, SourceError> {
        let (mut examined, unused) = match import(path, &settings.source)? {
            Some(imported) => {
                let examined = examined_import(&imported, stems(path), settings)?;
                text = Some(imported.original);
                examined
            }
            None => match read_source(path, &settings.source) {
                Err(SourceError::NeedsArguments { needed, fault, .. }) => {
                    let is_asked_for = found == Found::Named;
                    (lint_undeclared(path, &needed, &fault, is_asked_for, settings), Vec::new())
                }
                read => {
                    let fails = matches!(read, Err(SourceError::Xacro { .. }));
                    is_part = fails && found == Found::Included;
                    let read = read?;
                    let xml = Xml::new(&read.text);
                    is_part = read.trail.is_some()
                        && match found {
                            Found::Named => false,
                            Found::InFolder => has_no_link(&xml),
                            Found::Included => {
                                has_no_link(&xml) || has_no_name(&xml) || has_open_ends(&xml)
                            }
                        };
                    let examined = of_source(path, &read, &xml, settings);
                    text = read.trail.is_none().then_some(read.text);
                    examined
                }
            },
        };
        examined.report.xacro_arguments.clone_from(&job.arguments);
        stale.extend(unused);
        if let Some(baseline) = &settings.baseline {
            stale.extend(baseline.apply(path, &mut examined));
        }
        Ok(examined)
    };
    let mut examined =
        Examined::caught(Kind::Urdf, &seen, || examine().map_err(|error| unread(path, &error)));
    examined.report.path = seen;
    examined.report.xacro_arguments.clone_from(&job.arguments);
    (!is_part).then_some(Linted { examined, stale, text })
}

/// Why a file was not examined that cannot be read.
fn unread(path: &Path, error: &SourceError) -> NotExamined {
    let cause = match error {
        SourceError::Untaken { .. } => Cause::Arguments,
        _ => Cause::Unreadable,
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let at = error.place().map(|at| {
        (urdd_source::written::seen_from(Path::new(&at.file), folder), at.line, at.column)
    });
    answer::placed(answer::not_examined(cause, error.to_string()), at)
}

fn as_written(path: &Path, files: &Files) -> Option<String> {
    let bytes = files.read(path, MAX_SOURCE_BYTES).ok();
    bytes.and_then(|bytes| String::from_utf8(bytes).ok())
}

/// Lints the text of a file as [`read_source`] gives it; `xml` is of this text. Where xacro made the text, places also say
/// where in the xacro files that is written. Of the settings, only those that change what the rules compute apply here.
pub fn lint_source(
    path: &Path,
    read: &SourceText,
    xml: &Xml<'_>,
    settings: &LintSettings,
) -> Examined {
    of_source(path, read, xml, settings).0
}

fn of_source(
    path: &Path,
    read: &SourceText,
    xml: &Xml<'_>,
    settings: &LintSettings,
) -> (Examined, Vec<StaleIgnore>) {
    let name = stems(path).1;
    let original = read.original.as_ref();
    let (mut examined, mut unused) = examined(xml, original, &name, &read.folder, settings);
    if let Some(trail) = &read.trail {
        let expansion = (read.text.as_str(), trail, path, name.as_str());
        // A line of the expansion.
        unused.iter_mut().for_each(|one| one.path.clone_from(&name));
        say_where_expanded(expansion, &mut examined.checks, &mut examined.report.programs);
    }
    (examined, unused)
}

/// Lints a text. `name` is its file's name in the report; relative mesh names refer to `folder`. Of the settings, only
/// those that change what the rules compute apply here.
pub fn lint_text(text: &str, name: &str, folder: &Path, settings: &LintSettings) -> Examined {
    examined(&Xml::new(text), None, name, folder, settings).0
}

/// What is found in the URDF of an import of the file `name` in `folder`, and the comments in it that matched nothing.
///
/// # Errors
/// If its files are more than memory may hold.
fn examined_import(
    imported: &Imported,
    (folder, name): (PathBuf, String),
    settings: &LintSettings,
) -> Result<(Examined, Vec<StaleIgnore>), SourceError> {
    let folder = settings.source.files.canonicalize(&folder).unwrap_or(folder);
    let settings =
        LintSettings { source: imported.settings(&settings.source)?, ..settings.clone() };
    let (mut examined, unused) =
        examined(&Xml::new(imported.text()), None, &name, Path::new("/"), &settings);
    let find = |kind: &str, part: &str| {
        let (file, line, column) = imported.place(kind, part)?;
        let is_main = file == imported.shown;
        Some(WrittenAt {
            file: if is_main {
                name.clone()
            } else {
                urdd_source::written::seen_from(Path::new(file), &folder)
            },
            line: Some(Count(line)),
            column: Some(Count(column)),
            ..WrittenAt::default()
        })
    };
    say_where(&mut examined.checks, &name, |place| {
        let (kind, part) = named(place.subject.as_deref()?)?;
        find(kind, part)
    });
    for effect in examined.report.programs.iter_mut().flat_map(|program| &mut program.effects) {
        // Such as `joint/elbow/limit`; a name may have slashes too.
        let part = effect.part.as_deref().and_then(|part| part.split_once('/'));
        let written = part.filter(|(kind, _)| matches!(*kind, "link" | "joint"));
        let written = written.and_then(|(kind, part)| {
            let ends = part.match_indices('/').map(|(end, _)| end).chain([part.len()]);
            ends.rev().find_map(|end| find(kind, &part[..end]))
        });
        // An effect has a line, and no file.
        let written = written.filter(|at| at.file == name);
        (effect.line, effect.column) = written.map_or((None, None), |at| (at.line, at.column));
    }
    examined.report.imported = Some(imported_from(imported));
    Ok((examined, unused))
}

fn imported_from(imported: &Imported) -> ImportedFrom {
    let report = &imported.report;
    let part = |what: &str, count: usize, how: Option<&str>| ImportedPart {
        what: what.to_owned(),
        count: Count::saturating(count),
        how: how.map(str::to_owned),
    };
    let otherwise = report.otherwise().map(|(what, count, how)| part(what, count, Some(how)));
    ImportedFrom {
        format: report.format.name().to_owned(),
        otherwise: otherwise.collect(),
        lost: report.lost().map(|(what, count)| part(what, count, None)).collect(),
        notes: report.remarks.iter().map(ToString::to_string).collect(),
    }
}
