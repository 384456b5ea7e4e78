//! The arguments that say how xacro files are expanded.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;

use urdd_source::XacroSettings;

/// How xacro files are expanded.
#[derive(Args)]
pub(super) struct XacroArguments {
    /// Also expands macros in .urdf files, and the xacro files named in a recipe or found in a folder by `view` or `lint`.
    #[arg(long)]
    pub(super) xacro: bool,

    /// Time limit for xacro per file, in seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..))]
    xacro_timeout: u32,
}

impl XacroArguments {
    /// Settings that use them, with these arguments for the files.
    pub(super) fn settings(&self, arguments: Vec<String>) -> XacroSettings {
        XacroSettings {
            expand_urdf: self.xacro,
            arguments,
            time_limit: Duration::from_secs(self.xacro_timeout.into()),
        }
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
