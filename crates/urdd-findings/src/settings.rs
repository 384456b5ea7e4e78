//! Settings of a run: the rules to report, and how what is found is reported.

use std::collections::{BTreeMap, HashMap};
use std::str::FromStr;

use globset::{Glob, GlobSet};
use thiserror::Error;

use super::check::{Check, Examined, Outcome};
use super::code::Code;
use super::part::SkipReason;
use super::places::fold;
use urdd_directory::account::AccountError;
use urdd_directory::cancellation::Cancellation;
use urdd_format::report::{Kind, Severity, StaleIgnore};
use urdd_format::root_metadata::ConformanceClass;

/// The names that settings have for programs that read URDFs. A distribution of ROS stands for its urdfdom and its
/// ros2_control, `gazebo` and `ros2_control` for each of their versions.
pub const NAMES: &[&str] = &[
    "ros",
    "lyrical",
    "rolling",
    "jazzy",
    "kilted",
    "humble",
    "noetic",
    "iron",
    "gazebo",
    "fortress",
    "harmonic",
    "jetty",
    "mujoco",
    "mujoco3.3",
    "pinocchio",
    "drake",
    "pybullet",
    "isaac",
    "newton",
    "three",
    "ros2_control",
    "gz_ros2_control",
];

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
    /// It has very many patterns.
    #[error(transparent)]
    Account(#[from] AccountError),
}

/// Maximum number of variants of a settings file: each is expanded by xacro.
pub(crate) const MAX_VARIANTS: usize = 1000;

/// What is wrong with an entry of `[[robot]]`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum RobotError {
    #[error("`{0}` is no name of an argument; expected letters, digits and `_`")]
    Name(String),
    #[error("the list of `{0}` is empty; write a value, or leave the argument out")]
    NoValues(String),
    #[error(
        "with the lists of `{path}`, the file declares {count} robots, and may declare {MAX_VARIANTS}; shorten the lists"
    )]
    Many { path: String, count: usize },
    #[error(transparent)]
    Account(#[from] AccountError),
}

impl Settings {
    /// Applies severities, ignores and the selection, then leaves out what follows from what is left. Returns the ignores that
    /// match nothing.
    pub fn apply(&self, examined: &mut [Examined]) -> Vec<StaleIgnore> {
        let mut used = vec![false; self.ignores.len()];
        for Examined { report, checks } in examined {
            // By file: the ignores whose patterns match it.
            let mut known: HashMap<Option<String>, Vec<usize>> = HashMap::new();
            let matching = |file: Option<&str>| -> Vec<usize> {
                let path = format!("{}/{}", report.path, file.unwrap_or(""));
                let is_of = |ignore: &Ignore| {
                    ignore.path.is_match(&path)
                        || report.kind == Kind::Urdf && ignore.path.is_match(&report.path)
                };
                let all = self.ignores.iter().enumerate();
                all.filter(|(_, ignore)| is_of(ignore)).map(|(place, _)| place).collect()
            };
            for check in &mut *checks {
                if let Some(severity) = self.severities.get(&check.rule.code) {
                    check.severity = *severity;
                    check.findings.iter_mut().for_each(|finding| finding.severity = None);
                }
                let mut reason = None;
                check.findings.retain(|finding| {
                    let file = &finding.place.file;
                    if !known.contains_key(file) {
                        known.insert(file.clone(), matching(file.as_deref()));
                    }
                    let is_of = |place: &&usize| {
                        self.ignores[**place].code.is_none_or(|code| code == check.rule.code)
                    };
                    let ignore = known[file].iter().find(is_of).copied();
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

/// The bytes that a pattern takes, about.
pub(crate) const PATTERN: usize = 16 << 10;

pub(crate) fn matcher(pattern: &str) -> Result<GlobSet, SettingsError> {
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

pub(crate) fn parse_code(text: &str) -> Result<Code, SettingsError> {
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

/// A rule or a family of rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Codes {
    /// One rule.
    One(Code),
    /// All rules of a family.
    Family(&'static str),
}

/// Neither the code of a rule nor a family.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no rule and no family of rules `{0}`; `urdd explain` lists them")]
pub struct UnknownCodes(String);

impl FromStr for Codes {
    type Err = UnknownCodes;

    fn from_str(text: &str) -> Result<Self, UnknownCodes> {
        let family = || {
            let mut families = Code::ALL.iter().map(|code| code.family());
            families.find(|family| family.eq_ignore_ascii_case(text))
        };
        let one = Code::parse(text).map(Codes::One);
        one.or_else(|| family().map(Codes::Family)).ok_or_else(|| UnknownCodes(text.to_owned()))
    }
}

impl Codes {
    /// Whether it includes a rule.
    pub fn holds(self, code: Code) -> bool {
        match self {
            Codes::One(one) => one == code,
            Codes::Family(family) => code.family() == family,
        }
    }
}

/// The rules to report.
#[derive(Debug, Clone, Default)]
pub struct Selection {
    /// Only these; all if empty.
    pub select: Vec<Codes>,
    /// Except these.
    pub ignore: Vec<Codes>,
}

impl Selection {
    /// Removes what is not reported. A crashed rule is always reported.
    fn apply(&self, checks: &mut Vec<Check>) {
        let holds = |list: &[Codes], code| list.iter().any(|codes| codes.holds(code));
        checks.retain(|check| {
            let code = check.rule.code;
            let selected = self.select.is_empty() || holds(&self.select, code);
            matches!(check.outcome, Outcome::Crashed(_)) || (selected && !holds(&self.ignore, code))
        });
    }
}
