//! Shared code of the commands that run an external program.

use std::fmt::Display;
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::{Args, ValueEnum};
use serde::Serialize;
use serde_json::Value;

use super::follow::{Follow, cannot_write};
use crate::cli::output::{self, Failure, about};
use crate::cli::signals::{self, Signals};
use urdd_conformance::skips::{self, Skip};
use urdd_directory::{outputs, regular};
use urdd_validate::report;

/// Maximum size of a skip list, in bytes.
const MAX_SKIP_BYTES: u64 = 1 << 20;

/// Maximum length of a log line, in bytes. A command's output is limited to 2,000 in it.
const MAX_LOG_LINE: u64 = 1 << 20;

/// Exit status: everything passed, except for skipped items.
const PASSED: u8 = 0;
/// Exit status: something failed, or a skip is stale.
const FAILED: u8 = 1;

/// Arguments of both commands.
#[derive(Args)]
pub struct RunArguments {
    /// Time limit for each run of the command, in seconds. After that, it and the processes it started are killed
    /// (docs/security.md states the limits).
    #[arg(long, value_name = "SECONDS", default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..))]
    timeout: u64,

    /// A list of known failures, one per line, each with its reason after a `#`. An entry that passes fails the run.
    #[arg(long, value_name = "FILE")]
    skip: Option<PathBuf>,

    /// Format of the result on standard output.
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,

    /// Also writes the result as JSON to a file.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Writes each result to a file as soon as it is known, as a line of JSON, so that an interrupted run keeps its
    /// results. Does not overwrite an existing file that is not such a log.
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,

    /// Lets --log overwrite a file that is not a log.
    #[arg(long, requires = "log")]
    force: bool,

    /// Number of commands that run at the same time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,

    /// Keeps the folders that the command runs on in this folder, which must be new or empty.
    #[arg(long, value_name = "DIR")]
    pub keep: Option<PathBuf>,

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

    /// The requested number of concurrent commands.
    pub fn jobs(&self) -> Option<usize> {
        self.jobs.map(usize::from)
    }

    /// Creates the progress display and the log.
    pub fn follow(&self) -> Result<Follow, Failure> {
        let Some(path) = &self.log else {
            return Ok(Follow::new(None));
        };
        self.check_log(path)?;
        let file = outputs::stream(path, true).map_err(|error| cannot_write(path, &error))?;
        Ok(Follow::new(Some((path.clone(), file))))
    }

    /// An error if the log would overwrite another file.
    fn check_log(&self, path: &Path) -> Result<(), Failure> {
        outputs::check_name(path)?;
        if self.output.as_deref() == Some(path) {
            Err("--log and --output name the same file: give two")?;
        }
        // Writing to devices and pipes is allowed.
        let is_there = fs::metadata(path).is_ok_and(|there| there.is_file() && there.len() > 0);
        if is_there && !self.force && !is_log(path) {
            Err(about(path)(
                "this file exists and is not a log of this command: give another file, or --force to overwrite it",
            ))?;
        }
        Ok(())
    }

    /// The skip list.
    pub fn skips(&self, words: usize, form: &'static str) -> Result<Vec<Skip>, Failure> {
        let Some(file) = &self.skip else {
            return Ok(Vec::new());
        };
        let shown = file.display();
        let unreadable = |reason: &dyn Display| format!("{shown}: cannot be read: {reason}");
        let bytes = regular::read(file, MAX_SKIP_BYTES).map_err(|error| unreadable(&error))?;
        let text = String::from_utf8(bytes).map_err(|_| unreadable(&"it is not UTF-8"))?;
        Ok(skips::read(&text, words, form).map_err(|error| format!("{shown}: {error}"))?)
    }

    /// Prints a result, and writes it to the file of `--output`.
    pub fn print(&self, result: &impl Serialize, human: &str) -> Result<(), Failure> {
        let json = report::json(result)?;
        if let Some(file) = &self.output {
            output::write_file(file, &json)?;
        }
        Ok(output::print(if self.format == Format::Json { &json } else { human })?)
    }
}

/// Whether a file begins like the output of [`Follow::done`].
fn is_log(file: &Path) -> bool {
    let Ok(file) = regular::open(file) else {
        return false;
    };
    let mut line = Vec::new();
    let mut reader = BufReader::new(file.take(MAX_LOG_LINE));
    let read = reader.read_until(b'\n', &mut line);
    let value: Option<Value> = read.ok().and_then(|_| serde_json::from_slice(&line).ok());
    let has = |key: &str| value.as_ref().is_some_and(|value| value.get(key).is_some());
    has("end") && (has("id") || has("robot"))
}

/// Runs a command that starts other programs, until a signal cancels it. `result` returns whether everything passed, or
/// an error message.
pub fn run(result: impl FnOnce(&Signals) -> Result<bool, Failure>) -> ExitCode {
    let stopped = "stopped by a signal; all started processes have ended";
    signals::run(Some(stopped), |signals| Ok(if result(signals)? { PASSED } else { FAILED }))
}
