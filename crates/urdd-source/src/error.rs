//! Why a description could not be read.

use std::fmt;
use std::path::Path;

use thiserror::Error;
use urdd_directory::cancellation::Cancelled;
use urdd_directory::position::Position;
use urdd_format::escape;

use crate::fault::PlacedFault;
use crate::note::{MacroCall, SourcePlace};
use crate::unused_arguments::UnusedArgument;

/// Maximum number of faults of a file that are shown one by one.
const MOST_SHOWN: usize = 5;

/// Why a description could not be read. `file` is the file as the user named it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages say it")]
pub enum SourceError {
    #[error("{file}: cannot be read: {reason}")]
    Read { file: String, reason: String },
    #[error("{}", fault_lines(file, faults))]
    Refused { file: String, faults: Vec<PlacedFault> },
    #[error(
        "{file}: expanding this file needs the program `xacro`, which is not on the PATH; install it (`pip install xacro`, or ROS), or expand the file elsewhere: `xacro {file} > robot.urdf`"
    )]
    NoXacro { file: String },
    #[error("{}: {fault}", xacro_failed(file, fault))]
    Xacro { file: String, fault: Box<XacroFault> },
    /// It was not expanded, for want of arguments.
    #[error(
        "{}: values are missing for {}; give them as `name:=value`, or declare the robots in urdd.toml (`urdd lint --write-robots`); {fault}",
        escape::line(file),
        listed(needed)
    )]
    NeedsArguments { file: String, needed: Vec<XacroArgument>, fault: Box<XacroFault> },
    /// xacro made a robot, without these arguments that are declared of the file: another one than was asked for.
    #[error("{}: {}", escape::line(file), unused_words(unused))]
    UnusedArguments { file: String, unused: Vec<UnusedArgument> },
    /// A description of another format than URDF.
    #[error("{}{}: {}", escape::line(file), place(*line, *column), escape::line(fault))]
    Import { file: String, line: u32, column: u32, fault: String },
    #[error("{file}: this is a URDF already; `urdd generate` takes it as it is")]
    IsUrdf { file: String },
    /// A file of loops is named for a description of another format than URDF.
    #[error(
        "{}: a description of the format {format} says its loops itself, so `--loops` has no meaning; leave it out, or `urdd import` it and edit NAME.loops.toml",
        escape::line(file)
    )]
    SaysItsLoops { file: String, format: &'static str },
    #[error("stopped before it was finished; nothing was changed")]
    Cancelled,
    /// A bug in this program.
    #[error(
        "{file}: the reader failed: {reason}; this is a bug in the program, please report it with the file"
    )]
    Internal { file: String, reason: String },
}

impl From<Cancelled> for SourceError {
    fn from(_: Cancelled) -> Self {
        SourceError::Cancelled
    }
}

/// A place in a file; that of a binary one is empty.
fn place(line: u32, column: u32) -> String {
    if line == 0 { String::new() } else { format!(":{line}:{column}") }
}

impl SourceError {
    /// That a file, as the user named it, cannot be read.
    pub fn unread(file: &str, reason: impl ToString) -> Self {
        SourceError::Read { file: file.to_owned(), reason: reason.to_string() }
    }

    /// Where it is: the innermost place that is known, in the file or in one that it includes. Line and column are 0 for a
    /// file as a whole; `None` for an error of no file.
    pub fn place(&self) -> Option<SourcePlace> {
        let at = |file: &String, line, column| SourcePlace { file: file.clone(), line, column };
        Some(match self {
            SourceError::Refused { file, faults } => match faults.first() {
                Some(fault) => fault.place(file),
                None => at(file, 0, 0),
            },
            SourceError::Xacro { file, fault } => {
                fault.place.clone().unwrap_or_else(|| at(file, 0, 0))
            }
            SourceError::NeedsArguments { file, needed, fault } => {
                match needed.first().and_then(|argument| argument.at) {
                    Some(place) => at(file, place.line, place.column),
                    None => fault.place.clone().unwrap_or_else(|| at(file, 0, 0)),
                }
            }
            SourceError::UnusedArguments { file, unused } => {
                match unused.iter().find_map(|one| one.nearest.as_ref()) {
                    Some((_, own, place)) => {
                        let file = Path::new(file).with_file_name(own);
                        at(&file.to_string_lossy().into_owned(), place.line, place.column)
                    }
                    None => at(file, 1, 1),
                }
            }
            SourceError::Import { file, line, column, .. } => at(file, *line, *column),
            SourceError::Read { file, .. }
            | SourceError::NoXacro { file }
            | SourceError::IsUrdf { file }
            | SourceError::SaysItsLoops { file, .. }
            | SourceError::Internal { file, .. } => at(file, 0, 0),
            SourceError::Cancelled => return None,
        })
    }

    /// A machine-readable code for the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            SourceError::Read { .. } => "unreadable",
            SourceError::Refused { .. }
            | SourceError::Import { .. }
            | SourceError::IsUrdf { .. }
            | SourceError::SaysItsLoops { .. } => "refused",
            SourceError::NoXacro { .. } => "no-xacro",
            SourceError::Xacro { .. } => "xacro-failed",
            SourceError::NeedsArguments { .. } => "needs-arguments",
            SourceError::UnusedArguments { .. } => "argument-not-taken",
            SourceError::Cancelled => "cancelled",
            SourceError::Internal { .. } => "internal",
        }
    }
}

/// Why xacro did not expand a file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct XacroFault {
    /// What is wrong, on one line.
    pub reason: String,
    /// The files that were read and the macros that were called, each on one line; then what to do, if that is known.
    pub further: Vec<String>,
    /// The package that was not found.
    pub package: Option<String>,
    /// What xacro was at when it failed.
    pub place: Option<SourcePlace>,
    /// The calls of macros around that, innermost first.
    pub calls: Vec<MacroCall>,
}

/// Where xacro failed, and at what.
fn xacro_failed(file: &str, fault: &XacroFault) -> String {
    match &fault.place {
        Some(place) if place.file == file => format!("{place}: `xacro` could not expand it"),
        Some(place) => format!("{place}: `xacro` could not expand {file}"),
        None => format!("{file}: `xacro` could not expand it"),
    }
}

impl XacroFault {
    /// The property that is not defined, where that is what is wrong.
    pub(crate) fn undefined(&self) -> Option<&str> {
        let (name, rest) = self.reason.split_once("name '")?.1.split_once('\'')?;
        rest.starts_with(" is not defined").then_some(name)
    }
}

impl From<String> for Box<XacroFault> {
    fn from(reason: String) -> Self {
        Box::new(XacroFault { reason, ..XacroFault::default() })
    }
}

impl fmt::Display for XacroFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)?;
        self.further.iter().try_for_each(|line| write!(f, "; {line}"))?;
        let call = |call: &MacroCall| {
            write!(f, "; by the macro `{}`, called at {}", escape::line(&call.name), call.place)
        };
        self.calls.iter().try_for_each(call)
    }
}

/// What is wrong with declared arguments, and what to do.
fn unused_words(unused: &[UnusedArgument]) -> String {
    let one = |one: &UnusedArgument| {
        let tip = match &one.nearest {
            Some((like, file, at)) => {
                format!(
                    "`{like}` ({file}:{at}) has no value and may be meant: correct one of the two names"
                )
            }
            None => "correct its name there, or remove it".to_owned(),
        };
        format!(
            "urdd.toml gives the argument `{}`, which no file of the robot takes; {tip}",
            one.name
        )
    };
    escape::line(&unused.iter().map(one).collect::<Vec<_>>().join("; ")).into_owned()
}

/// Arguments, on one line.
fn listed(needed: &[XacroArgument]) -> String {
    let all: Vec<String> = needed.iter().map(ToString::to_string).collect();
    escape::line(&all.join(", ")).into_owned()
}

/// The faults of a file, one per line: a name must not add line breaks.
fn fault_lines(file: &str, faults: &[PlacedFault]) -> String {
    let line =
        |of: &PlacedFault| format!("{}: {}", of.place(file), escape::line(&of.fault.to_string()));
    let mut lines: Vec<String> = faults.iter().take(MOST_SHOWN).map(line).collect();
    if let Some(more) = faults.len().checked_sub(MOST_SHOWN).filter(|more| *more > 0) {
        lines.push(format!("{}: and {more} more such faults", escape::line(file)));
    }
    lines.join("\n")
}

/// Maximum number of values in a message.
const SHOWN: usize = 6;

/// An argument.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XacroArgument {
    /// Its name.
    pub name: String,
    /// Its default as it is written.
    pub default: Option<String>,
    /// Values for which the package has files, else those that launch files have, else those that conditions ask for; or those
    /// for which the file defines a property that is missing.
    pub values: Vec<String>,
    /// Whether a condition (`xacro:if`, `xacro:unless`) asks for it.
    pub is_condition: bool,
    /// Whether a value has to be given: there is no default, the package has no files for it, a property is missing with it,
    /// or xacro does not know it yet.
    pub is_needed: bool,
    /// Where the file itself declares or uses it first.
    pub at: Option<Position>,
}

impl fmt::Display for XacroArgument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.name)?;
        if !self.values.is_empty() {
            let more = if self.values.len() > SHOWN { ", …" } else { "" };
            let shown = self.values.iter().take(SHOWN).map(String::as_str);
            write!(f, " ({}{more})", shown.collect::<Vec<_>>().join(", "))?;
        }
        Ok(())
    }
}
