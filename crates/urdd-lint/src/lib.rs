//! Internal to urdd; no stability promise.
//!
//! What is odd about a URDF, for those who write one: the rules LNT, and those of the validator that need only the
//! source. The rules are about robots, not about URDDs: they are described in docs/lint.md, and may change with every
//! version. [`lint`] examines files, [`lint_text`] a text that an editor holds.

// Hidden modules are public for `tests/`.
mod beside;
mod checked_in;
mod examine;
mod fix;
mod fixes;
mod geometry;
#[doc(hidden)]
pub mod hull;
mod in_programs;
#[doc(hidden)]
pub mod meaning;
pub mod pose;
mod programs;
mod rounding;
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

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use urdd_directory::cancellation::{Cancellation, Cancelled};
use urdd_directory::file_type::FileType;
use urdd_directory::watched::{map_robots, watched};
use urdd_findings::answer;
use urdd_findings::check::{Check, Examined, blank};
use urdd_findings::code::Code;
use urdd_findings::run::Run;
use urdd_format::index::Count;
use urdd_format::readable::first_of;
use urdd_format::report::{
    Cause, ImportedFrom, ImportedPart, Kind, NotExamined, StaleIgnore, WrittenAt,
};
use urdd_import::{Imported, import};
use urdd_source::arguments::conditions;
use urdd_source::checked_in::urdf_of;
use urdd_source::macros::{has_no_link, has_no_name, has_open_ends};
use urdd_source::robots::Job;
use urdd_source::{Files, MAX_SOURCE_BYTES, Settings, SourceError, SourceText, read_source};
use urdd_xml::Xml;

use examine::{Examination, examined, rules_to_run};
use sources::{Sources, sources, stems};
use written::{named, say_where, say_where_expanded};

/// Lints URDFs, xacro files, and all of them below folders, in parallel.
///
/// # Errors
/// If a path has nothing to examine, or the run is cancelled.
pub fn lint(paths: &[PathBuf], settings: &LintSettings) -> Result<Run, LintError> {
    let Sources { jobs, excluded, batch } = sources(paths, settings)?;
    let not_made = checked_in::not_made(&jobs, &settings.source);
    let all: HashSet<&Path> = jobs.iter().map(|job| job.source.as_path()).collect();
    let is_found = |job: &Job| {
        let is_xacro = FileType::Xacro.is_of(&job.source);
        let urdf = Some(urdf_of(&job.source)).filter(|_| is_xacro);
        let is_examined = |urdf: &PathBuf| all.contains(urdf.as_path());
        Found {
            is_wanted: !batch.may_drop(&job.source),
            is_included: batch.description.may_be_part(&job.source),
            checked_in: urdf.filter(is_examined),
            is_given: paths.contains(&job.source),
        }
    };
    let run = &settings.source.cancellation;
    let given: Arc<[PathBuf]> = paths.into();
    let lint = |job: &Job| {
        let seen = seen_from(&job.source, &given);
        let (own, found, given) = (job.clone(), is_found(job), Arc::clone(&given));
        let mut settings = settings.clone();
        settings.compares_checked_in = found.checked_in.is_none();
        let work = move |cancellation: &Cancellation| {
            settings.source.cancellation = cancellation.clone();
            lint_file(&own, &found, &given, &settings)
        };
        watched(run, &seen, work).unwrap_or_else(|limit| {
            let examined = Examined::without_checks(Kind::Urdf, &seen, answer::beyond(limit));
            Ok(Linted { examined, stale: Vec::new(), srdfs: Vec::new(), text: None })
        })
    };
    let linted = map_robots(run, &jobs, lint);
    run.check()?;
    let passed = |why: Passed| {
        let all = jobs.iter().zip(&linted);
        let of = all.filter(move |(_, one)| one.as_ref().err() == Some(&why));
        of.map(|(job, _)| job.source.as_path()).collect::<Vec<_>>()
    };
    let mut asides = batch.asides(passed(Passed::Part).len());
    asides.extend(checked_in::asides(&passed(Passed::Same), &not_made));
    let of_srdfs = [Code::LNT045, Code::LNT063];
    if rules_to_run(settings).any(|rule| of_srdfs.contains(&rule.description.code)) {
        let used = linted.iter().flatten().flat_map(|one| &one.srdfs);
        let used = used.filter_map(|path| settings.source.files.canonicalize(path).ok());
        asides.extend(srdf::unmatched(&batch, &used.collect(), &settings.source));
    }
    let linted =
        jobs.into_iter().zip(linted).filter_map(|(job, one)| Some((job.source, one.ok()?)));
    let (files, linted): (Vec<PathBuf>, Vec<Linted>) = linted.unzip();
    let mut run = run_of(&files, linted, excluded, settings);
    run.asides = asides;
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
    let found = Found { is_wanted: true, is_given: true, ..Found::default() };
    let mut linted = lint_file(&job, &found, &from, settings).ok();
    settings.source.cancellation.check()?;
    let text = linted.as_mut().and_then(|linted| linted.text.take());
    let text = text.or_else(|| as_written(path, &settings.source.files));
    Ok((run_of(&paths, Vec::from_iter(linted), 0, settings), text))
}

/// Maximum number of arguments that are named.
const MAX_NAMED: usize = 5;

struct Linted {
    examined: Examined,
    /// Ignores and comments that matched nothing.
    stale: Vec<StaleIgnore>,
    /// The SRDFs of the robot.
    srdfs: Vec<PathBuf>,
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
#[derive(Clone, Default)]
struct Found {
    /// A person names it, or declares it: it is to be a robot.
    is_wanted: bool,
    /// A person names it on the command line.
    is_given: bool,
    /// It is in a folder, and another file there includes it.
    is_included: bool,
    /// The `.urdf` of a xacro file's name beside it, which is examined too.
    checked_in: Option<PathBuf>,
}

impl Found {
    fn may_be_part(&self) -> bool {
        self.is_included && !self.is_wanted
    }

    /// Why a file is not examined whose text is this.
    fn passed(&self, read: &SourceText, xml: &Xml<'_>, settings: &LintSettings) -> Option<Passed> {
        let is_made = read.trail.is_some();
        let has_no_robot = !self.is_wanted && (is_made || self.is_included) && has_no_link(xml);
        let is_open = || has_no_name(xml) || is_made && has_open_ends(xml);
        if has_no_robot || self.may_be_part() && is_open() {
            return Some(Passed::Part);
        }
        let urdf = self.checked_in.as_ref().filter(|_| is_made && !self.is_given);
        let is_same = |urdf: &&PathBuf| checked_in::is_same(urdf, xml, &settings.source);
        urdf.filter(is_same).map(|_| Passed::Same)
    }
}

/// Why a file is not examined.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Passed {
    /// It is a part of robots.
    Part,
    /// It makes the `.urdf` of its name beside it.
    Same,
}

/// Lints a file, but for one that turns out to be a part of robots: its expansion has no link; or another file includes it,
/// and it has no expansion by itself, or one without a name for the robot, or one that is no whole tree. One that makes the
/// `.urdf` beside it is examined as that.
fn lint_file(
    job: &Job,
    found: &Found,
    given: &[PathBuf],
    settings: &LintSettings,
) -> Result<Linted, Passed> {
    let settings = &LintSettings { source: job.settings(&settings.source), ..settings.clone() };
    let path = job.source.as_path();
    let seen = seen_from(path, given);
    let (mut stale, mut srdfs, mut text, mut passed) = (Vec::new(), Vec::new(), None, None);
    let mut examine = || -> Result<Examined, SourceError> {
        let Examination { mut examined, stale: unused, srdfs: of_robot } =
            match import(path, &settings.source)? {
                Some(imported) => {
                    let examined = examined_import(&imported, stems(path), settings)?;
                    text = Some(imported.original);
                    examined
                }
                None => match read_source(path, &settings.source) {
                    Err(SourceError::NeedsArguments { needed, fault, .. }) => Examination::alone(
                        lint_undeclared(path, &needed, &fault, found.is_wanted, settings),
                    ),
                    read => {
                        let fails = matches!(read, Err(SourceError::Xacro { .. }));
                        passed = Some(Passed::Part).filter(|_| fails && found.may_be_part());
                        let read = read?;
                        let xml = Xml::new(&read.text);
                        passed = found.passed(&read, &xml, settings);
                        if passed.is_some() {
                            return Ok(Examined {
                                report: blank(Kind::Urdf, &seen),
                                checks: Vec::new(),
                            });
                        }
                        let examined = of_source(path, &read, &xml, settings);
                        text = read.trail.is_none().then_some(read.text);
                        examined
                    }
                },
            };
        examined.report.xacro_arguments.clone_from(&job.arguments);
        stale.extend(unused);
        srdfs = of_robot;
        if let Some(baseline) = &settings.baseline {
            stale.extend(baseline.apply(path, &mut examined));
        }
        Ok(examined)
    };
    let mut examined =
        Examined::caught(Kind::Urdf, &seen, || examine().map_err(|error| unread(path, &error)));
    let open = examined.report.not_examined.as_mut().filter(|_| !found.is_wanted);
    if let Some(why) = open.filter(|_| has_nameless_text(path, &settings.source.files)) {
        why.is_asked_for = false;
        why.reason += "; its `<robot>` has no name, so it may be a part for files that include it, and none here is known to: exclude it then";
    }
    examined.report.path = seen;
    examined.report.xacro_arguments.clone_from(&job.arguments);
    passed.map_or(Ok(Linted { examined, stale, srdfs, text }), Err)
}

/// Whether a file has a `<robot>` without a name, as it is written.
fn has_nameless_text(path: &Path, files: &Files) -> bool {
    as_written(path, files).is_some_and(|text| has_no_name(&Xml::new(&text)))
}

/// Why a file was not examined that cannot be read.
fn unread(path: &Path, error: &SourceError) -> NotExamined {
    let cause = match error {
        SourceError::UnusedArguments { .. } => Cause::Arguments,
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
    of_source(path, read, xml, settings).examined
}

fn of_source(
    path: &Path,
    read: &SourceText,
    xml: &Xml<'_>,
    settings: &LintSettings,
) -> Examination {
    let name = stems(path).1;
    let original = read.original.as_ref();
    let mut found = examined(xml, original, &name, &read.folder, settings);
    if let Some(trail) = &read.trail {
        let examined = &mut found.examined;
        say_conditions(path, examined, &settings.source);
        let expansion = (read.text.as_str(), trail, path, name.as_str());
        // A line of the expansion.
        found.stale.iter_mut().for_each(|one| one.path.clone_from(&name));
        say_where_expanded(expansion, &mut examined.checks, &mut examined.report.programs);
    }
    found
}

/// Says of what is no tree which arguments may make it one.
fn say_conditions(path: &Path, examined: &mut Examined, settings: &Settings) {
    let is_tree = |check: &&mut Check| check.rule.code == Code::URD004;
    let Some(check) = examined.checks.iter_mut().find(is_tree) else { return };
    if check.findings.is_empty() {
        return;
    }
    let listed: Vec<String> = conditions(path, settings).iter().map(ToString::to_string).collect();
    if !listed.is_empty() {
        let shown = first_of(listed.into_iter(), MAX_NAMED);
        let more =
            format!("; or give another value of an argument that conditions ask for: {shown}");
        check.findings.iter_mut().for_each(|finding| finding.message += &more);
    }
}

/// Lints a text. `name` is its file's name in the report; relative mesh names refer to `folder`. Of the settings, only
/// those that change what the rules compute apply here.
pub fn lint_text(text: &str, name: &str, folder: &Path, settings: &LintSettings) -> Examined {
    examined(&Xml::new(text), None, name, folder, settings).examined
}

/// What is found in the URDF of an import of the file `name` in `folder`, and the comments in it that matched nothing.
///
/// # Errors
/// If its files are more than memory may hold.
fn examined_import(
    imported: &Imported,
    (folder, name): (PathBuf, String),
    settings: &LintSettings,
) -> Result<Examination, SourceError> {
    let folder = settings.source.files.canonicalize(&folder).unwrap_or(folder);
    let settings =
        LintSettings { source: imported.settings(&settings.source)?, ..settings.clone() };
    let mut found = examined(&Xml::new(imported.text()), None, &name, Path::new("/"), &settings);
    let examined = &mut found.examined;
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
    Ok(found)
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
