//! The arguments that say how xacro files are expanded.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use super::output::{Failure, shown};
use urdd_source::{XACRO_TIMEOUT, XacroSettings};

/// How xacro files are expanded.
#[derive(Args)]
pub(super) struct XacroArguments {
    /// Also expands macros in .urdf files, and the xacro files named in a recipe, found in a folder by `view` or `lint`, or found
    /// by `lint` as an SRDF of the robot.
    #[arg(long)]
    pub(super) xacro: bool,

    /// Time limit for xacro per file, in seconds.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = timeout)]
    xacro_timeout: Duration,
}

fn timeout(word: &str) -> Result<Duration, String> {
    let seconds = XACRO_TIMEOUT.parse(word)?;
    XacroSettings::seconds(seconds).map_err(|error| error.to_string())
}

impl XacroArguments {
    /// Settings that use them, with these arguments for the files.
    pub(super) fn settings(&self, arguments: Vec<String>) -> XacroSettings {
        XacroSettings { expand_urdf: self.xacro, arguments, time_limit: self.xacro_timeout }
    }
}

/// Splits the words into robots and xacro arguments.
pub(super) fn split(words: &[PathBuf]) -> (Vec<PathBuf>, Vec<String>) {
    let (mut robots, mut arguments) = (Vec::new(), Vec::new());
    for word in words {
        let text = word.to_str().unwrap_or_default();
        let is_argument = text.split_once(":=").is_some_and(|(name, _)| {
            let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
            !name.is_empty() && name.chars().all(is_of_name)
        });
        if is_argument { arguments.push(text.to_owned()) } else { robots.push(word.clone()) }
    }
    (robots, arguments)
}

/// The xacro arguments, where nothing else may be.
///
/// # Errors
/// A message about a word that is none.
pub(super) fn only_arguments(words: &[PathBuf]) -> Result<Vec<String>, Failure> {
    match split(words) {
        (others, arguments) if others.is_empty() => Ok(arguments),
        (others, _) => Err(format!(
            "{}: not an argument of xacro, which has the form name:=value",
            shown(&others[0])
        ))?,
    }
}
