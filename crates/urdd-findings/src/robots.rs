//! The robots that a settings file declares: xacro files with their arguments.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Deserialize;
use thiserror::Error;
use toml::Spanned;

use urdd_directory::account::{Account, Overdrawn};
use urdd_directory::file_type::stem;

/// Maximum number of variants of a settings file: each is expanded by xacro.
pub const MAX_VARIANTS: usize = 1000;

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
    Overdrawn(#[from] Overdrawn),
}

/// An entry as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Entry {
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
/// `bytes` is the length of the file.
pub(crate) fn declared(
    entries: Vec<Entry>,
    bytes: usize,
) -> Result<Vec<DeclaredRobot>, (usize, RobotError)> {
    let account = Account::default();
    account.deposit(bytes);
    let mut robots = Vec::new();
    for entry in entries {
        let start = entry.path.span().start;
        let mut count = 1usize;
        for (name, values) in &entry.args {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            let refused = |error| (name.span().start, error);
            let text = name.get_ref();
            if text.is_empty() || !text.chars().all(is_of_name) {
                return Err(refused(RobotError::Name(text.clone())));
            }
            if let Values::Many(values) = values {
                if values.is_empty() {
                    return Err(refused(RobotError::NoValues(text.clone())));
                }
                count = count.saturating_mul(values.len());
            }
        }
        let all = robots.len().saturating_add(count);
        if all > MAX_VARIANTS {
            let path = entry.path.into_inner();
            return Err((start, RobotError::Many { path, count: all }));
        }
        let charged = account.charge(count.saturating_mul(entry.cost()));
        charged.map_err(|error| (start, error.into()))?;
        robots.extend(entry.variants());
    }
    Ok(robots)
}

impl Entry {
    /// The bytes of the largest of its robots, at most. A value is also a part of a name.
    fn cost(&self) -> usize {
        let longest = |values: &Values| match values {
            Values::One(value) => value.text().len(),
            Values::Many(values) => values.iter().map(|one| one.text().len()).max().unwrap_or(0),
        };
        let argument = |(name, values): (&Spanned<String>, &Values)| {
            size_of::<String>() + name.get_ref().len() + 3 * longest(values)
        };
        let own = self.path.get_ref().len() + self.name.as_ref().map_or(0, String::len);
        size_of::<DeclaredRobot>() + 2 * own + self.args.iter().map(argument).sum::<usize>()
    }

    fn variants(self) -> Vec<DeclaredRobot> {
        let file = PathBuf::from(self.path.into_inner());
        let mut all = vec![DeclaredRobot { file, name: self.name, arguments: Vec::new() }];
        for (argument, values) in &self.args {
            let (values, is_list) = match values {
                Values::One(value) => (std::slice::from_ref(value), false),
                Values::Many(values) => (&**values, values.len() > 1),
            };
            let with = |robot: DeclaredRobot| {
                values.iter().map(move |value| {
                    let (mut robot, value) = (robot.clone(), value.text());
                    robot.arguments.push(format!("{}:={value}", argument.get_ref()));
                    if is_list {
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
