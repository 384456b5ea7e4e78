//! What the commands that run somebody's program have in common.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::{Args, ValueEnum};
use serde::Serialize;

use crate::cli::output;
use crate::conformance::skips::{self, Skip};

/// Exit status: everything passed but what is skipped.
pub const PASSED: u8 = 0;
/// Exit status: something did not, or a skip is stale.
pub const FAILED: u8 = 1;
/// Exit status: wrong usage, or nothing could be run.
pub const USAGE: u8 = 2;

/// Arguments of both commands.
#[derive(Args)]
pub struct RunArguments {
    /// Seconds that the command may take each time; then it and all that it started is killed.
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..))]
    timeout: u64,

    /// A list of what is known to fail, a line each, with the reason after a `#`. An entry that passes fails the run.
    #[arg(long, value_name = "FILE")]
    skip: Option<PathBuf>,

    /// How the result is written to standard output.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,

    /// Writes the result as JSON to a file too.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// The command, after `--`.
    #[arg(last = true, required = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

/// How a result is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    Human,
    /// As JSON; `urdd schema list` names its schema.
    Json,
}

impl RunArguments {
    /// The time limit.
    pub fn limit(&self) -> Duration {
        Duration::from_secs(self.timeout)
    }

    /// The skip list.
    pub fn skips(&self, words: usize, form: &'static str) -> Result<Vec<Skip>, String> {
        let Some(file) = &self.skip else {
            return Ok(Vec::new());
        };
        let shown = file.display();
        let text = fs::read_to_string(file)
            .map_err(|error| format!("{shown}: cannot be read: {error}"))?;
        skips::read(&text, words, form).map_err(|error| format!("{shown}: {error}"))
    }

    /// Prints a result, and writes it into the file that was asked for.
    pub fn print(&self, result: &impl Serialize, human: &str) -> Result<(), String> {
        let json = serde_json::to_string_pretty(result).map_err(|error| error.to_string())? + "\n";
        if let Some(file) = &self.output {
            write(file, &json)?;
        }
        match self.format {
            Format::Human => output::print(human),
            Format::Json => output::print(&json),
        }
        Ok(())
    }
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text).map_err(|error| format!("{}: cannot be written: {error}", file.display()))
}
