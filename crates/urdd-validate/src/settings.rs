//! Settings: what `urdd.toml` may say, and how it changes what is reported.

use std::collections::BTreeMap;

use globset::{Glob, GlobSet};
use serde::Deserialize;
use thiserror::Error;

use super::code::Code;
use super::engine::Outcome;
use super::examined::Examined;
use super::rule::Severity;
use super::selection::Selection;
use super::skip::SkipReason;
use urdd_directory::cancellation::Cancellation;
use urdd_format::report::StaleIgnore;
use urdd_format::root_metadata::ConformanceClass;

/// Settings of a run.
#[derive(Debug, Clone, Default)]
pub struct Settings {
    /// The conformance class to hold every URDD to, instead of the one that it claims.
    pub class: Option<ConformanceClass>,
    /// Whether to recompute sampled data in full (`--deep`).
    pub deep: bool,
    /// From which severity on a run fails; `None` means from errors on.
    pub fail_on: Option<Severity>,
    /// Severities that replace those of the rules.
    pub severities: BTreeMap<Code, Severity>,
    /// Findings that are not wanted.
    pub ignores: Vec<Ignore>,
    /// Folders in which no URDD is looked for.
    pub excludes: Vec<Exclude>,
    /// Which rules are reported.
    pub selection: Selection,
    /// Where it is asked to stop: before the next rule, with [`ValidateError::Cancelled`](super::ValidateError).
    pub cancellation: Cancellation,
}

/// Folders in which no URDD is looked for.
#[derive(Debug, Clone)]
pub struct Exclude {
    /// Which: matched against the path of a URDD's folder, and of each folder that it lies in, from
    /// the path that was given.
    pub path: GlobSet,
    /// The same as it was written.
    pub pattern: String,
}

impl Exclude {
    /// Reads a pattern.
    ///
    /// # Errors
    /// Where it cannot be read.
    pub fn new(pattern: &str) -> Result<Exclude, SettingsError> {
        let path = matcher(pattern.strip_suffix('/').unwrap_or(pattern))?;
        Ok(Exclude {
            path,
            pattern: pattern.to_owned(),
        })
    }

    /// Whether a folder, or one that it lies in, is meant; paths with forward slashes.
    pub fn matches(&self, path: &str) -> bool {
        let parents = path.match_indices('/').map(|(end, _)| &path[..end]);
        let mut folders = parents.chain([path]);
        folders.any(|folder| self.path.is_match(folder))
    }
}

/// A kind of finding that is not wanted in some files.
#[derive(Debug, Clone)]
pub struct Ignore {
    /// The rule; `None` for all.
    pub code: Option<Code>,
    /// Which files: matched against the URDD's name, a slash, and the file's path.
    pub path: GlobSet,
    /// The same as it was written.
    pub pattern: String,
    /// Why.
    pub reason: String,
}

/// What is wrong with a settings file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SettingsError {
    /// Not TOML, or with unknown keys.
    #[error("{0}")]
    Syntax(String),
    /// A code that no rule has.
    #[error("there is no rule {0}; `urdd explain` lists them")]
    UnknownCode(String),
    /// Not a severity.
    #[error("`{0}` is no severity; write \"error\", \"warning\" or \"info\"")]
    UnknownSeverity(String),
    /// Not a conformance class.
    #[error("`{0}` is no conformance class; write \"core\", \"geometry\" or \"shapes\"")]
    UnknownClass(String),
    /// A pattern that cannot be read.
    #[error("the pattern `{pattern}` cannot be read: {reason}")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// What is wrong with it.
        reason: String,
    },
    /// An ignore without a reason.
    #[error("the ignore of `{0}` has an empty reason; say why, for whoever reads this in a year")]
    EmptyReason(String),
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
struct File {
    class: Option<String>,
    fail_on: Option<String>,
    severity: BTreeMap<String, String>,
    ignore: Vec<FileIgnore>,
    exclude: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileIgnore {
    code: Option<String>,
    path: String,
    reason: String,
}

impl Settings {
    /// Reads settings from the text of a `urdd.toml`.
    ///
    /// # Errors
    /// Where it is not TOML, has keys or codes that do not exist, or patterns that cannot be read.
    pub fn from_toml(text: &str) -> Result<Settings, SettingsError> {
        let file: File =
            toml::from_str(text).map_err(|error| SettingsError::Syntax(error.to_string()))?;
        let code = |text: &str| {
            Code::parse(text).ok_or_else(|| SettingsError::UnknownCode(text.to_owned()))
        };
        let mut settings = Settings {
            class: file.class.as_deref().map(parse_class).transpose()?,
            fail_on: file.fail_on.as_deref().map(parse_severity).transpose()?,
            ..Settings::default()
        };
        for (rule, severity) in &file.severity {
            settings
                .severities
                .insert(code(rule)?, parse_severity(severity)?);
        }
        for ignore in file.ignore {
            if ignore.reason.trim().is_empty() {
                return Err(SettingsError::EmptyReason(ignore.path));
            }
            settings.ignores.push(Ignore {
                code: ignore.code.as_deref().map(code).transpose()?,
                path: matcher(&ignore.path)?,
                pattern: ignore.path,
                reason: ignore.reason,
            });
        }
        for pattern in &file.exclude {
            settings.excludes.push(Exclude::new(pattern)?);
        }
        Ok(settings)
    }

    /// Applies severities, ignores and the selection. Returns the ignores that match nothing.
    pub fn apply(&self, examined: &mut [Examined]) -> Vec<StaleIgnore> {
        let mut used = vec![false; self.ignores.len()];
        for Examined { report, checks } in examined {
            for check in &mut *checks {
                if let Some(severity) = self.severities.get(&check.rule.code) {
                    check.severity = *severity;
                }
                let mut reason = None;
                check.findings.retain(|finding| {
                    let file = finding.place.file.as_deref().unwrap_or("");
                    let path = format!("{}/{file}", report.path);
                    let ignore = self.ignores.iter().position(|ignore| {
                        ignore.code.is_none_or(|code| code == check.rule.code)
                            && ignore.path.is_match(&path)
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

/// Longest pattern, bytes: one that nests a hundred thousand alternatives exhausts the stack.
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
    // A set of one: a pattern that is beyond the bounds of the regex that it becomes is an error
    // here, and a panic of `Glob::compile_matcher`.
    Glob::new(pattern)
        .and_then(|glob| GlobSet::builder().add(glob).build())
        .map_err(|error| refused(error.kind().to_string()))
}

/// A severity by its word.
///
/// # Errors
/// Where there is none of that name.
pub fn parse_severity(text: &str) -> Result<Severity, SettingsError> {
    [Severity::Error, Severity::Warning, Severity::Info]
        .into_iter()
        .find(|severity| severity.as_str() == text)
        .ok_or_else(|| SettingsError::UnknownSeverity(text.to_owned()))
}

/// A conformance class by its word, in any case.
///
/// # Errors
/// Where there is none of that name.
pub fn parse_class(text: &str) -> Result<ConformanceClass, SettingsError> {
    ConformanceClass::ALL
        .iter()
        .copied()
        .find(|class| class.as_str().eq_ignore_ascii_case(text))
        .ok_or_else(|| SettingsError::UnknownClass(text.to_owned()))
}
