//! Settings: the contents of `urdd.toml`, and how they change what is reported.

use std::collections::BTreeMap;

use globset::{Glob, GlobSet};
use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use super::cause::fold;
use super::check::Outcome;
use super::code::Code;
use super::examined::Examined;
use super::programs::NAMES;
use super::robots::{DeclaredRobot, Entry, RobotError, declared};
use super::selection::Selection;
use super::skip::SkipReason;
use urdd_directory::cancellation::Cancellation;
use urdd_directory::position::{self, Position};
use urdd_format::report::{Kind, Severity, StaleIgnore};
use urdd_format::root_metadata::ConformanceClass;

/// Settings of a run.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The conformance class that every URDD must meet, instead of the one that it claims.
    pub class: Option<ConformanceClass>,
    /// Whether to recompute sampled data completely (`--deep`).
    pub deep: bool,
    /// The lowest severity at which a run fails; `None` for errors.
    pub fail_on: Option<Severity>,
    /// Severities that replace those of rules.
    pub severities: BTreeMap<Code, Severity>,
    /// Findings to ignore.
    pub ignores: Vec<Ignore>,
    /// Folders that are not searched for URDDs.
    pub excludes: Vec<Exclude>,
    /// The rules to report.
    pub selection: Selection,
    /// The programs that a URDF is for, by names of [`NAMES`]; where there are none, all count.
    pub programs: Vec<String>,
    /// Cancellation: checked before each rule.
    pub cancellation: Cancellation,
}

/// Folders that are not searched for URDDs.
#[derive(Debug, Clone)]
pub struct Exclude {
    /// Matches the path of a URDD's folder, or of a folder above it, relative to the given path.
    pub path: GlobSet,
    /// The pattern as written.
    pub pattern: String,
}

impl Exclude {
    /// Parses a pattern.
    ///
    /// # Errors
    /// If it is not a valid pattern.
    pub fn new(pattern: &str) -> Result<Exclude, SettingsError> {
        let path = matcher(pattern.strip_suffix('/').unwrap_or(pattern))?;
        Ok(Exclude { path, pattern: pattern.to_owned() })
    }

    /// Whether it matches a folder or a folder above it; paths with forward slashes.
    pub fn matches(&self, path: &str) -> bool {
        let parents = path.match_indices('/').map(|(end, _)| &path[..end]);
        let mut folders = parents.chain([path]);
        folders.any(|folder| self.path.is_match(folder))
    }
}

/// Findings to ignore in some files.
#[derive(Debug, Clone)]
pub struct Ignore {
    /// The rule; `None` for all.
    pub code: Option<Code>,
    /// Matches the URDD's name, a slash, and the file's path; for a URDF by itself, also its path alone.
    pub path: GlobSet,
    /// The pattern as written.
    pub pattern: String,
    /// The reason.
    pub reason: String,
}

/// What is wrong with a settings file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SettingsError {
    /// Not TOML, or with unknown keys.
    #[error("{0}")]
    Syntax(String),
    /// A code without a rule.
    #[error("there is no rule {0}; `urdd explain` lists them")]
    UnknownCode(String),
    /// Not a severity.
    #[error("`{0}` is not a severity; write \"error\", \"warning\" or \"info\"")]
    UnknownSeverity(String),
    /// Not a conformance class.
    #[error("`{0}` is not a conformance class; write \"core\", \"geometry\" or \"shapes\"")]
    UnknownClass(String),
    /// Not a program.
    #[error("there is no program `{0}`; write some of {all}", all = NAMES.join(", "))]
    UnknownProgram(String),
    /// An invalid pattern.
    #[error("the pattern `{pattern}` cannot be read: {reason}")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// The fault.
        reason: String,
    },
    /// An ignore without a reason.
    #[error("the ignore of `{0}` has an empty reason; state why, for later readers")]
    EmptyReason(String),
    /// An entry of `[[robot]]`.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
struct File {
    class: Option<Spanned<String>>,
    fail_on: Option<Spanned<String>>,
    severity: BTreeMap<Spanned<String>, Spanned<String>>,
    ignore: Vec<FileIgnore>,
    exclude: Vec<Spanned<String>>,
    #[serde(rename = "for")]
    programs: Vec<Spanned<String>>,
    baseline: Option<String>,
    robot: Vec<Entry>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileIgnore {
    code: Option<Spanned<String>>,
    path: Spanned<String>,
    reason: Spanned<String>,
}

/// The content of a settings file.
pub(crate) struct Parsed {
    /// The settings.
    pub(crate) settings: Settings,
    /// The file that `baseline` names.
    pub(crate) baseline: Option<String>,
    /// The robots that it declares.
    pub(crate) robots: Vec<DeclaredRobot>,
}

impl Parsed {
    /// As [`Parsed::new`], with the place in the words where that is all that is known.
    pub(crate) fn of_text(text: &str) -> Result<Self, SettingsError> {
        Parsed::new(text).map_err(|(place, error)| match (place, error) {
            (Some(place), SettingsError::Syntax(words)) => {
                SettingsError::Syntax(format!("at {place}: {words}"))
            }
            (_, error) => error,
        })
    }

    /// Parses the text of a settings file; what is wrong comes with its place.
    pub(crate) fn new(text: &str) -> Result<Self, (Option<Position>, SettingsError)> {
        let mut file: File = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|span| position::position(text, span.start));
            (place, SettingsError::Syntax(error.message().to_owned()))
        })?;
        let baseline = file.baseline.clone();
        let placed =
            |(start, error): (usize, SettingsError)| (Some(position::position(text, start)), error);
        let robots = declared(std::mem::take(&mut file.robot), text.len());
        let robots = robots.map_err(|(start, error)| placed((start, error.into())))?;
        let settings = file.settings().map_err(placed)?;
        Ok(Parsed { settings, baseline, robots })
    }
}

impl File {
    /// The settings; what is wrong comes with its byte offset.
    fn settings(self) -> Result<Settings, (usize, SettingsError)> {
        let mut settings = Settings {
            class: self.class.map(|class| parsed(&class, parse_class)).transpose()?,
            fail_on: self.fail_on.map(|name| parsed(&name, parse_severity)).transpose()?,
            ..Settings::default()
        };
        for (rule, severity) in &self.severity {
            let rule = parsed(rule, parse_code)?;
            settings.severities.insert(rule, parsed(severity, parse_severity)?);
        }
        for ignore in self.ignore {
            if ignore.reason.get_ref().trim().is_empty() {
                let error = SettingsError::EmptyReason(ignore.path.into_inner());
                return Err((ignore.reason.span().start, error));
            }
            settings.ignores.push(Ignore {
                code: ignore.code.map(|code| parsed(&code, parse_code)).transpose()?,
                path: parsed(&ignore.path, matcher)?,
                pattern: ignore.path.into_inner(),
                reason: ignore.reason.into_inner(),
            });
        }
        for pattern in &self.exclude {
            settings.excludes.push(parsed(pattern, Exclude::new)?);
        }
        for name in &self.programs {
            settings.programs.push(parsed(name, parse_program)?);
        }
        Ok(settings)
    }
}

fn parsed<T>(
    text: &Spanned<String>,
    parse: impl Fn(&str) -> Result<T, SettingsError>,
) -> Result<T, (usize, SettingsError)> {
    parse(text.get_ref()).map_err(|error| (text.span().start, error))
}

impl Settings {
    /// Parses the text of a `urdd.toml`. Its `baseline` is left to [`SettingsFile`](super::settings_file::SettingsFile).
    ///
    /// # Errors
    /// If it is not TOML, or has unknown keys, unknown codes or invalid patterns.
    pub fn from_toml(text: &str) -> Result<Settings, SettingsError> {
        Ok(Parsed::of_text(text)?.settings)
    }

    /// Applies severities, ignores and the selection, then leaves out what follows from what is left. Returns the ignores that
    /// match nothing.
    pub fn apply(&self, examined: &mut [Examined]) -> Vec<StaleIgnore> {
        let mut used = vec![false; self.ignores.len()];
        for Examined { report, checks } in examined {
            for check in &mut *checks {
                if let Some(severity) = self.severities.get(&check.rule.code) {
                    check.severity = *severity;
                    let own = check.findings.iter_mut().map(|finding| &mut finding.severity);
                    own.for_each(|own| *own = None);
                }
                let mut reason = None;
                check.findings.retain(|finding| {
                    let file = finding.place.file.as_deref().unwrap_or("");
                    let path = format!("{}/{file}", report.path);
                    let ignore = self.ignores.iter().position(|ignore| {
                        ignore.code.is_none_or(|code| code == check.rule.code)
                            && (ignore.path.is_match(&path)
                                || (report.kind == Kind::Urdf
                                    && ignore.path.is_match(&report.path)))
                    });
                    if let Some(place) = ignore {
                        used[place] = true;
                        reason = Some(&self.ignores[place].reason);
                    }
                    ignore.is_none()
                });
                if let (Some(reason), true) = (reason, check.findings.is_empty()) {
                    check.outcome = Outcome::Skipped(SkipReason::Ignored(reason.clone()));
                }
            }
            self.selection.apply(checks);
            fold(checks);
        }
        let stale = self.ignores.iter().zip(used).filter(|(_, used)| !used);
        stale
            .map(|(ignore, _)| StaleIgnore {
                code: ignore.code.map(|code| code.to_string()),
                path: ignore.pattern.clone(),
            })
            .collect()
    }
}

/// Maximum length of a pattern, bytes: a hundred thousand nested alternatives exhaust the stack.
const LONGEST_PATTERN: usize = 1000;

fn matcher(pattern: &str) -> Result<GlobSet, SettingsError> {
    let refused = |reason: String| SettingsError::Pattern {
        pattern: pattern.chars().take(LONGEST_PATTERN).collect(),
        reason,
    };
    if pattern.len() > LONGEST_PATTERN {
        return Err(refused(format!(
            "it is longer than {LONGEST_PATTERN} bytes; write several ignores"
        )));
    }
    // A set of one pattern: exceeding the limits of its regular expression is an error here, and a panic in
    // `Glob::compile_matcher`.
    Glob::new(pattern)
        .and_then(|glob| GlobSet::builder().add(glob).build())
        .map_err(|error| refused(error.kind().to_string()))
}

fn parse_code(text: &str) -> Result<Code, SettingsError> {
    Code::parse(text).ok_or_else(|| SettingsError::UnknownCode(text.to_owned()))
}

/// A severity by its name.
///
/// # Errors
/// If there is no such severity.
pub fn parse_severity(text: &str) -> Result<Severity, SettingsError> {
    [Severity::Error, Severity::Warning, Severity::Info]
        .into_iter()
        .find(|severity| severity.as_str() == text)
        .ok_or_else(|| SettingsError::UnknownSeverity(text.to_owned()))
}

/// A program by one of its names, in upper or lower case.
///
/// # Errors
/// If there is no such program.
pub fn parse_program(text: &str) -> Result<String, SettingsError> {
    let name = text.trim().to_lowercase();
    let unknown = || SettingsError::UnknownProgram(text.to_owned());
    NAMES.contains(&name.as_str()).then_some(name).ok_or_else(unknown)
}

/// A conformance class by its name, in upper or lower case.
///
/// # Errors
/// If there is no such class.
pub fn parse_class(text: &str) -> Result<ConformanceClass, SettingsError> {
    ConformanceClass::ALL
        .iter()
        .copied()
        .find(|class| class.as_str().eq_ignore_ascii_case(text))
        .ok_or_else(|| SettingsError::UnknownClass(text.to_owned()))
}
