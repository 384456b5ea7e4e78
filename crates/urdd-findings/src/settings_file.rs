//! The settings file `urdd.toml`: its settings, the robots that it declares, and what is wrong with it, and where.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use super::settings::{
    Exclude, Ignore, MAX_VARIANTS, PATTERN, RobotError, Settings, SettingsError, matcher,
    parse_class, parse_code, parse_program, parse_severity,
};
use urdd_directory::account::Account;
use urdd_directory::file_type::stem;
use urdd_directory::limits::MAX_TOML_BYTES;
use urdd_directory::listing::ReadError;
use urdd_directory::position::{Position, position};
use urdd_directory::regular;
use urdd_format::escape;

/// The usual name of a settings file.
pub const SETTINGS_FILE: &str = "urdd.toml";

/// The settings file in a folder, or in the nearest one above it. `None` for a relative folder.
pub fn nearest(folder: &Path) -> Option<PathBuf> {
    if !folder.is_absolute() {
        return None;
    }
    let mut files = folder.ancestors().map(|above| above.join(SETTINGS_FILE));
    files.find(|file| file.is_file())
}

/// The content of a settings file.
#[derive(Debug, Clone, Default)]
pub struct SettingsFile {
    /// How URDDs and URDFs are examined and reported.
    pub settings: Settings,
    /// The file with findings that `urdd lint` leaves out; names in it are seen from the settings file's folder.
    pub baseline: Option<PathBuf>,
    /// The robots that it declares, seen likewise.
    pub robots: Vec<DeclaredRobot>,
}

/// A robot of a settings file: an entry of `[[robot]]` with one value for each argument.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeclaredRobot {
    /// The URDF or xacro file, from the folder of the settings file.
    pub file: PathBuf,
    /// Its name, if the entry has one, or has several robots.
    pub name: Option<String>,
    /// Arguments for xacro, each as `name:=value`.
    pub arguments: Vec<String>,
}

/// What is wrong with a settings file, and where.
pub type SettingsFileError = FileError<SettingsError>;

/// Why a file that a person wrote cannot be used. `E` is what can be wrong with its content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError<E> {
    /// The file, as it was named.
    pub file: PathBuf,
    /// Where in the file.
    pub at: Option<Position>,
    /// What is wrong.
    pub fault: FileFault<E>,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FileFault<E> {
    /// It cannot be read.
    #[error(transparent)]
    Read(ReadError),
    /// Not UTF-8.
    #[error("it is not UTF-8")]
    NotUtf8,
    /// Its content is wrong.
    #[error(transparent)]
    Content(E),
}

impl<E: std::error::Error + 'static> std::error::Error for FileError<E> {}

impl<E: std::error::Error> Display for FileError<E> {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        write!(out, "{}", escape::line(&self.file.display().to_string()))?;
        if let Some(at) = self.at {
            write!(out, ":{at}")?;
        }
        write!(out, ": {}", self.fault)
    }
}

/// What `parse` makes of the text of a file of at most `limit` bytes.
pub(crate) fn read<T, E>(
    file: &Path,
    limit: u64,
    parse: impl FnOnce(&str) -> Result<T, (Option<Position>, E)>,
) -> Result<T, FileError<E>> {
    let refused = |at, fault| FileError { file: file.to_owned(), at, fault };
    let bytes =
        regular::read(file, limit).map_err(|error| refused(None, FileFault::Read(error)))?;
    let text = String::from_utf8(bytes).map_err(|_| refused(None, FileFault::NotUtf8))?;
    parse(&text).map_err(|(at, error)| refused(at, FileFault::Content(error)))
}

impl SettingsFile {
    /// The text of a settings file with lines at its end; what is there stays. A file that is missing is empty.
    ///
    /// # Errors
    /// If it cannot be read, or is not one, before or after.
    pub fn with_lines(file: &Path, lines: &str) -> Result<String, SettingsFileError> {
        let check = |text: &str| parsed(text, Path::new("")).map(drop);
        let mut text = String::new();
        if file.exists() {
            read(file, MAX_TOML_BYTES, |found| {
                text.push_str(found);
                check(found)
            })?;
        }
        let is_open = !text.is_empty() && !text.ends_with('\n');
        text.push_str(if is_open { "\n" } else { "" });
        text.push_str(if text.is_empty() { lines.trim_start() } else { lines });
        match check(&text) {
            Ok(()) => Ok(text),
            Err((at, error)) => {
                let fault = FileFault::Content(error);
                Err(FileError { file: file.to_owned(), at, fault })
            }
        }
    }

    /// Reads a settings file.
    ///
    /// # Errors
    /// If it cannot be read, or [`Settings::from_toml`] refuses it.
    pub fn read(file: &Path) -> Result<SettingsFile, SettingsFileError> {
        let folder = file.parent().unwrap_or(Path::new(""));
        read(file, MAX_TOML_BYTES, |text| parsed(text, folder))
    }

    /// The settings of a text that was read from a file in a folder.
    ///
    /// # Errors
    /// As [`Settings::from_toml`].
    pub fn from_toml(text: &str, folder: &Path) -> Result<SettingsFile, SettingsError> {
        parsed(text, folder).map_err(|(place, error)| match (place, error) {
            (Some(place), SettingsError::Syntax(words)) => {
                SettingsError::Syntax(format!("at {place}: {words}"))
            }
            (_, error) => error,
        })
    }
}

impl Settings {
    /// Parses the text of a `urdd.toml`. Its `baseline` is left to [`SettingsFile`].
    ///
    /// # Errors
    /// If it is not TOML, or has unknown keys, unknown codes or invalid patterns.
    pub fn from_toml(text: &str) -> Result<Settings, SettingsError> {
        Ok(SettingsFile::from_toml(text, Path::new(""))?.settings)
    }
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

/// Parses the text of a settings file in a folder; what is wrong comes with its place.
fn parsed(text: &str, folder: &Path) -> Result<SettingsFile, (Option<Position>, SettingsError)> {
    let file: File = toml::from_str(text).map_err(|error| {
        let place = error.span().map(|span| position(text, span.start));
        (place, SettingsError::Syntax(error.message().to_owned()))
    })?;
    let content = file.content(text.len(), folder);
    content.map_err(|(start, error)| (Some(position(text, start)), error))
}

impl File {
    /// The content of a file of so many bytes; what is wrong comes with its byte offset.
    fn content(self, bytes: usize, folder: &Path) -> Result<SettingsFile, (usize, SettingsError)> {
        let account = Account::default();
        account.deposit(bytes);
        let pattern = |text: &Spanned<String>| {
            let charged = account.charge(PATTERN);
            charged.map_err(|error| (text.span().start, SettingsError::Account(error)))
        };
        let robots = declared(self.robot, &account, folder)
            .map_err(|(start, error)| (start, SettingsError::Robot(error)))?;
        let mut settings = Settings {
            class: self.class.map(|class| at(&class, parse_class)).transpose()?,
            fail_on: self.fail_on.map(|name| at(&name, parse_severity)).transpose()?,
            ..Settings::default()
        };
        for (rule, severity) in &self.severity {
            let rule = at(rule, parse_code)?;
            settings.severities.insert(rule, at(severity, parse_severity)?);
        }
        for ignore in self.ignore {
            if ignore.reason.get_ref().trim().is_empty() {
                let error = SettingsError::EmptyReason(ignore.path.into_inner());
                return Err((ignore.reason.span().start, error));
            }
            pattern(&ignore.path)?;
            settings.ignores.push(Ignore {
                code: ignore.code.map(|code| at(&code, parse_code)).transpose()?,
                path: at(&ignore.path, matcher)?,
                pattern: ignore.path.into_inner(),
                reason: ignore.reason.into_inner(),
            });
        }
        for exclude in &self.exclude {
            pattern(exclude)?;
            settings.excludes.push(at(exclude, Exclude::new)?);
        }
        for name in &self.programs {
            settings.programs.push(at(name, parse_program)?);
        }
        let baseline = self.baseline.map(|baseline| folder.join(baseline));
        Ok(SettingsFile { settings, baseline, robots })
    }
}

/// What a text says; what is wrong comes with its byte offset.
fn at<T>(
    text: &Spanned<String>,
    parse: impl Fn(&str) -> Result<T, SettingsError>,
) -> Result<T, (usize, SettingsError)> {
    parse(text.get_ref()).map_err(|error| (text.span().start, error))
}

/// An entry of `[[robot]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Entry {
    path: Spanned<String>,
    name: Option<String>,
    #[serde(default)]
    args: BTreeMap<Spanned<String>, Values>,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a text, a number, true or false, or a list of these")]
enum Values {
    One(Value),
    Many(Vec<Value>),
}

impl Values {
    fn all(&self) -> &[Value] {
        match self {
            Values::One(value) => std::slice::from_ref(value),
            Values::Many(values) => values,
        }
    }
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Value {
    Text(String),
    Truth(bool),
    Whole(i64),
    Real(f64),
}

impl Value {
    fn text(&self) -> String {
        match self {
            Value::Text(text) => text.clone(),
            Value::Truth(truth) => truth.to_string(),
            Value::Whole(number) => number.to_string(),
            Value::Real(number) => format!("{number:?}"),
        }
    }
}

/// The robots of all entries: of each, the product of its lists. What is wrong comes with its byte offset.
fn declared(
    entries: Vec<Entry>,
    account: &Account,
    folder: &Path,
) -> Result<Vec<DeclaredRobot>, (usize, RobotError)> {
    let mut robots = Vec::new();
    for entry in entries {
        let start = entry.path.span().start;
        let mut count = 1usize;
        for (name, values) in &entry.args {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            let text = name.get_ref();
            if text.is_empty() || !text.chars().all(is_of_name) {
                return Err((name.span().start, RobotError::Name(text.clone())));
            }
            if values.all().is_empty() {
                return Err((name.span().start, RobotError::NoValues(text.clone())));
            }
            count = count.saturating_mul(values.all().len());
        }
        let all = robots.len().saturating_add(count);
        if all > MAX_VARIANTS {
            let path = entry.path.into_inner();
            return Err((start, RobotError::Many { path, count: all }));
        }
        let charged = account.charge(count.saturating_mul(entry.cost()));
        charged.map_err(|error| (start, error.into()))?;
        robots.extend(entry.variants(folder));
    }
    Ok(robots)
}

impl Entry {
    /// The bytes of the largest of its robots, at most. A value is also a part of a name.
    fn cost(&self) -> usize {
        let argument = |(name, values): (&Spanned<String>, &Values)| {
            let longest = values.all().iter().map(|one| one.text().len()).max().unwrap_or(0);
            size_of::<String>() + name.get_ref().len() + 3 * longest
        };
        let own = self.path.get_ref().len() + self.name.as_ref().map_or(0, String::len);
        size_of::<DeclaredRobot>() + 2 * own + self.args.iter().map(argument).sum::<usize>()
    }

    fn variants(self, folder: &Path) -> Vec<DeclaredRobot> {
        let file = folder.join(self.path.into_inner());
        let mut all = vec![DeclaredRobot { file, name: self.name, arguments: Vec::new() }];
        for (argument, values) in &self.args {
            let values = values.all();
            let with = |robot: DeclaredRobot| {
                values.iter().map(move |value| {
                    let (mut robot, value) = (robot.clone(), value.text());
                    robot.arguments.push(format!("{}:={value}", argument.get_ref()));
                    if values.len() > 1 {
                        let name = robot.name.unwrap_or_else(|| stem(&robot.file));
                        robot.name = Some(format!("{name}_{value}"));
                    }
                    robot
                })
            };
            all = all.into_iter().flat_map(with).collect();
        }
        all
    }
}
