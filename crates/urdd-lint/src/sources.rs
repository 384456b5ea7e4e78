//! Which files a run examines and what they are called in reports, and xacro files that need arguments before they can be.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use thiserror::Error;
use urdd_directory::cancellation::{Cancelled, Limit};
use urdd_directory::file_type::FileType;
use urdd_directory::watched::map_robots;
use urdd_findings::answer::{not_examined, placed};
use urdd_findings::check::{Check, Outcome};
use urdd_findings::check::{Examined, blank};
use urdd_findings::code::Code;
use urdd_findings::finding::Finding;
use urdd_format::report::{Cause, Kind, NotExamined, Severity, Urdd};
use urdd_source::arguments::{XacroArgument, conditions, declaration};
use urdd_source::macros::{has_no_link, has_no_name, has_open_ends};
use urdd_source::robots::{Batch, BatchError, Job, find};
use urdd_source::{Settings, SourceError, XacroFault, read_source};
use urdd_xml::Xml;

use crate::examine::rules_to_run;
use crate::settings::{LintSettings, NEEDS_ARGUMENTS};

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
    /// A robot takes more than it may, so that nothing is changed.
    #[error("{file}: {limit}; to mend the others, leave it out with --exclude")]
    Limit {
        /// The file.
        file: String,
        /// What it takes more of.
        limit: Limit,
    },
}

/// What comes of each file, within the limits of a robot.
pub(crate) fn within_limits<J: Sync, T: Send>(
    jobs: &[J],
    settings: &LintSettings,
    file: fn(&J) -> &Path,
    work: impl Fn(&J, &LintSettings) -> Option<T> + Sync,
) -> Result<Vec<T>, LintError> {
    let run = &settings.source.cancellation;
    let one = |job: &J| {
        let file = file(job).display().to_string();
        let robot = run.robot(&file);
        let mut settings = settings.clone();
        settings.source.cancellation = robot.clone();
        let done = work(job, &settings);
        match robot.limit() {
            Some(limit) => Some(Err(LintError::Limit { file, limit })),
            None => done.map(Ok),
        }
    };
    let found = map_robots(run, jobs, one);
    run.check()?;
    found.into_iter().flatten().collect()
}

pub(crate) struct Sources {
    pub jobs: Vec<Job>,
    /// The number of those that the settings exclude.
    pub excluded: usize,
    /// What else was found.
    pub batch: Batch,
}

pub(crate) fn sources(paths: &[PathBuf], settings: &LintSettings) -> Result<Sources, LintError> {
    let mut batch = find(paths, &settings.source)?;
    let mut jobs = std::mem::take(&mut batch.jobs);
    jobs.append(&mut batch.checked_in);
    // A xacro file is a program: it runs where somebody names it, or asks for xacro.
    let found = jobs.len();
    let is_named = |job: &Job| paths.contains(&job.source) || settings.source.xacro.expand_urdf;
    jobs.retain(|job| is_named(job) || !FileType::Xacro.is_of(&job.source));
    if jobs.is_empty() && found > 0 {
        return Err(LintError::OnlyXacro);
    }
    let all = jobs.len();
    jobs.retain(|job| {
        let seen = seen_from(&job.source, paths);
        !settings.report.excludes.iter().any(|exclude| exclude.matches(&seen))
    });
    let excluded = all - jobs.len();
    Ok(Sources { jobs, excluded, batch })
}

/// The folder and the name of a file.
pub(crate) fn stems(path: &Path) -> (PathBuf, String) {
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

/// What is found in a file that needs these arguments, and why it was not expanded. `is_asked_for`: a person names the file,
/// or declares robots of it, so that it is an error.
pub fn lint_undeclared(
    path: &Path,
    needed: &[XacroArgument],
    fault: &XacroFault,
    is_asked_for: bool,
    settings: &LintSettings,
) -> Examined {
    let name = stems(path).1;
    let listed: Vec<String> = needed.iter().map(ToString::to_string).collect();
    let lines = declaration(&path.to_string_lossy(), needed).replace('\n', " ");
    let message = format!(
        "the robot needs {}; `urdd lint --write-robots` writes into urdd.toml: {}; {}",
        listed.join(", "),
        lines.trim(),
        fault.reason,
    );
    let finding = |first: &XacroArgument| {
        let mut finding = Finding::in_file(name.as_str(), message.clone()).position(first.at);
        finding.place.subject = Some(format!("argument `{}`", first.name));
        finding.severity = is_asked_for.then_some(Severity::Error);
        finding
    };
    let checks = rules_to_run(settings).map(|rule| match rule.description.code {
        Code::LNT065 => {
            let found = needed.first().map(finding).into_iter().collect();
            Check::new(&rule.description, Outcome::Failed, found)
        }
        _ => Check::skipped(&rule.description, NEEDS_ARGUMENTS),
    });
    let words = format!("the robot needs {} (LNT065); {}", listed.join(", "), fault.reason);
    let why = NotExamined { is_asked_for, ..not_examined(Cause::Arguments, words) };
    let at = needed.first().and_then(|first| first.at);
    let why = placed(why, at.map(|at| (name.clone(), at.line, at.column)));
    let report = Urdd { not_examined: Some(why), ..blank(Kind::Urdf, &name) };
    Examined { report, checks: checks.collect() }
}

/// A xacro file of which nobody declares a robot, and that needs arguments.
#[derive(Debug, Clone)]
pub struct Undeclared {
    /// The file.
    pub file: PathBuf,
    /// The arguments, with the values that make a robot.
    pub needed: Vec<XacroArgument>,
}

impl Undeclared {
    /// The lines that declare its robots, for a settings file in a folder; `None` if there is no value for an
    /// argument, or its name cannot be written.
    pub fn lines(&self, folder: &Path) -> Option<String> {
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let has_values = self
            .needed
            .iter()
            .all(|argument| !argument.values.is_empty() && argument.name.chars().all(is_plain));
        // A link in the folder is a path of the folder, too.
        let [file, folder] = [self.file.as_path(), folder].map(|path| {
            let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
            path.components().collect::<PathBuf>()
        });
        let inside = file.strip_prefix(&folder).unwrap_or(&file);
        has_values.then(|| declaration(&inside.to_string_lossy(), &self.needed))
    }
}

/// The xacro files at these paths that need arguments. Xacro runs them as for [`lint`](crate::lint): values with which it
/// makes no robot are left out.
///
/// # Errors
/// As for [`lint`](crate::lint).
pub fn undeclared(
    paths: &[PathBuf],
    settings: &LintSettings,
) -> Result<Vec<Undeclared>, LintError> {
    let mut jobs = sources(paths, settings)?.jobs;
    jobs.retain(|job| job.arguments.is_empty());
    let found = within_limits(
        &jobs,
        settings,
        |job| &job.source,
        |job, settings| {
            let (file, source) = (&job.source, job.settings(&settings.source));
            let all = match read_source(file, &source) {
                Err(SourceError::NeedsArguments { needed, .. }) => {
                    vec![tried(file, needed, settings)]
                }
                Ok(read) if read.trail.is_some() && has_open_ends(&Xml::new(&read.text)) => {
                    completed(file, conditions(file, &source), &source)
                }
                _ => Vec::new(),
            };
            let robot = |needed| Undeclared { file: file.clone(), needed };
            Some(all.into_iter().map(robot).collect::<Vec<_>>())
        },
    )?;
    Ok(found.into_iter().flatten().collect())
}

/// Maximum number of values that are tried.
const MAX_TRIED: usize = 20;

/// Those of the arguments that make a whole tree of a file that is none, each by itself, with the values that do.
fn completed(
    file: &Path,
    mut all: Vec<XacroArgument>,
    settings: &Settings,
) -> Vec<Vec<XacroArgument>> {
    let mut left = MAX_TRIED;
    for argument in &mut all {
        let own = argument.default.take();
        argument.values.retain(|value| own.as_ref() != Some(value));
        argument.values.truncate(left);
        left -= argument.values.len();
        argument.values.retain(|value| {
            let word = format!("{}:={value}", argument.name);
            let read = read_source(file, &settings.with_declared(&[word]));
            read.is_ok_and(|read| {
                let xml = Xml::new(&read.text);
                !has_no_link(&xml) && !has_open_ends(&xml) && !has_no_name(&xml)
            })
        });
    }
    all.retain(|argument| !argument.values.is_empty());
    all.into_iter().map(|one| vec![one]).collect()
}

/// The arguments, each with those of its values that make a robot with the first values of the others.
fn tried(
    file: &Path,
    mut needed: Vec<XacroArgument>,
    settings: &LintSettings,
) -> Vec<XacroArgument> {
    let makes_robot = |values: &[(String, String)]| {
        let mut source = settings.source.clone();
        let words = values.iter().map(|(name, value)| format!("{name}:={value}"));
        source.xacro.arguments.extend(words);
        let read = read_source(file, &source);
        // Without the program nothing is known of them.
        let is_unknown =
            matches!(&read, Err(SourceError::NeedsArguments { .. } | SourceError::NoXacro { .. }));
        is_unknown || read.is_ok_and(|read| !has_no_link(&Xml::new(&read.text)))
    };
    let first =
        |argument: &XacroArgument| Some((argument.name.clone(), argument.values.first()?.clone()));
    for at in 0..needed.len() {
        let firsts: Vec<(String, String)> = needed.iter().filter_map(first).collect();
        let name = needed[at].name.clone();
        needed[at].values = std::mem::take(&mut needed[at].values)
            .into_par_iter()
            .filter(|value| {
                let mut values = firsts.clone();
                values.push((name.clone(), value.clone()));
                makes_robot(&values)
            })
            .collect();
    }
    needed
}
