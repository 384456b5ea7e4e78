//! Shared code of the commands that run an external program: arguments, the progress of a run, and its log.

use std::fmt::{self, Display};
use std::fs::{self, File};
use std::io::{BufRead, BufReader, IsTerminal, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use parking_lot::Mutex;
use serde::Serialize;
use serde_json::Value;

use crate::cli::output::{self, Failure, Signals, about};
use urdd_conformance::running::{Skip, read_skips};
use urdd_directory::{outputs, regular};
use urdd_validate::report;

/// Maximum size of a skip list, in bytes.
const MAX_SKIP_BYTES: u64 = 1 << 20;

/// Maximum length of a log line, in bytes. A command's output is limited to 2,000 in it.
const MAX_LOG_LINE: u64 = 1 << 20;

/// Maximum size of a log that is read, in bytes.
const MAX_LOG_BYTES: u64 = 64 << 20;

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
    #[arg(long, value_enum, default_value_t = SuiteFormat::Human)]
    format: SuiteFormat,

    /// Also writes the result as JSON to a file.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Writes each result to a file as soon as it is known, as a line of JSON, so that an interrupted run keeps its
    /// results. Does not overwrite an existing file that is not such a log.
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,

    /// Runs only what failed according to a file that --log wrote. It may be the file that --log now writes.
    #[arg(long, value_name = "LOG")]
    failed: Option<PathBuf>,

    /// Lets --log overwrite a file that is not a log.
    #[arg(long, requires = "log")]
    force: bool,

    /// Number of commands that run at the same time.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,

    /// Keeps the folders that the command runs on in this folder, which must be new or empty.
    #[arg(long, value_name = "DIR")]
    pub keep: Option<PathBuf>,

    /// The command, after `--`.
    #[arg(last = true, required = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

/// How a result is written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SuiteFormat {
    /// For people.
    Human,
    /// As JSON; `urdd schema list` names its schema.
    Json,
}

impl RunArguments {
    pub fn limit(&self) -> Duration {
        Duration::from_secs(self.timeout)
    }

    pub fn follow(&self) -> Result<Follow, Failure> {
        let Some(path) = &self.log else {
            return Ok(Follow::new(None));
        };
        self.check_log(path)?;
        let file = outputs::stream(path, true).map_err(|error| cannot_write(path, &error))?;
        Ok(Follow::new(Some((path.clone(), file))))
    }

    /// Names of what failed according to a log; `None` for no log.
    pub fn failed(&self) -> Result<Option<Vec<String>>, Failure> {
        let Some(file) = &self.failed else {
            return Ok(None);
        };
        let text = read(file, MAX_LOG_BYTES)?;
        let mut names = Vec::new();
        for (index, line) in text.lines().enumerate() {
            let value: Value = serde_json::from_str(line).unwrap_or_default();
            let Some(name) = name(&value) else {
                let reason = format!("line {} is not of a log of this command", index + 1);
                return Err(about(file)(reason).into());
            };
            let has_fault = value.get("fault").is_some_and(|fault| !fault.is_null());
            if has_fault || value["status"] == "failed" {
                names.push(name.to_owned());
            }
        }
        if names.is_empty() {
            Err(about(file)("nothing failed in this log"))?;
        }
        Ok(Some(names))
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

    pub fn skips(&self, words: usize, form: &'static str) -> Result<Vec<Skip>, Failure> {
        let Some(file) = &self.skip else {
            return Ok(Vec::new());
        };
        let text = read(file, MAX_SKIP_BYTES)?;
        let skips = read_skips(&text, words, form);
        Ok(skips.map_err(|error| format!("{}: {error}", file.display()))?)
    }

    /// Prints a result, and writes it to the file of `--output`. `human` writes it for people.
    pub fn print<T: Serialize>(
        &self,
        result: &T,
        human: impl Fn(&T, &mut String) -> fmt::Result,
    ) -> Result<(), Failure> {
        let (json, mut text) = (report::json(result)?, String::new());
        human(result, &mut text)?;
        if let Some(file) = &self.output {
            output::write_file(file, &json)?;
        }
        Ok(output::print(if self.format == SuiteFormat::Json { &json } else { &text })?)
    }
}

/// The text of a file.
fn read(file: &Path, most: u64) -> Result<String, String> {
    let unreadable = |reason: &dyn Display| format!("{}: cannot be read: {reason}", file.display());
    let bytes = regular::read(file, most).map_err(|error| unreadable(&error))?;
    String::from_utf8(bytes).map_err(|_| unreadable(&"it is not UTF-8"))
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
    value.is_some_and(|value| name(&value).is_some())
}

/// What a line of a log is about.
fn name(line: &Value) -> Option<&str> {
    line.get("end")?;
    line.get("id").or_else(|| line.get("robot"))?.as_str()
}

/// Runs a command that starts other programs, until a signal cancels it. `result` returns whether everything passed, except
/// for skipped items; a failed item and a stale skip have the exit status 1.
pub fn run(result: impl FnOnce(&Signals) -> Result<bool, Failure>) -> Result<u8, Failure> {
    let stopped = "stopped by a signal; all started processes have ended";
    output::stoppable(Some(stopped), |signals| Ok(u8::from(!result(signals)?)))
}

/// Time between two lines where standard error is not a terminal.
const INTERVAL: Duration = Duration::from_secs(10);

fn cannot_write(file: &Path, error: &std::io::Error) -> String {
    format!("{}: cannot be written: {error}", file.display())
}

/// A progress bar on a terminal, or else a line every ten seconds; and the log.
pub struct Follow {
    bar: ProgressBar,
    state: Arc<Mutex<State>>,
    /// Dropped at the end: no more lines.
    lines: Option<Sender<()>>,
}

#[derive(Default)]
struct State {
    log: Option<(PathBuf, File)>,
    of: usize,
    done: usize,
    wrong: usize,
    /// Why the log could not be written.
    failed: Option<String>,
}

impl State {
    fn line(&self) -> String {
        format!("{} of {}, {} wrong", self.done, self.of, self.wrong)
    }
}

impl Follow {
    /// Begins to follow a run. `log` is an open file with its path.
    pub fn new(log: Option<(PathBuf, File)>) -> Follow {
        if std::io::stderr().is_terminal() {
            return Follow::with(ProgressDrawTarget::stderr(), log);
        }
        let mut follow = Follow::with(ProgressDrawTarget::hidden(), log);
        follow.print_every(INTERVAL, |line| {
            // Nobody may read it.
            let _ = writeln!(std::io::stderr().lock(), "{line}");
        });
        follow
    }

    fn with(target: ProgressDrawTarget, log: Option<(PathBuf, File)>) -> Follow {
        let bar = ProgressBar::with_draw_target(None, target);
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} {msg} {eta}") {
            bar.set_style(style);
        }
        let state = State { log, ..State::default() };
        Follow { bar, state: Arc::new(Mutex::new(state)), lines: None }
    }

    fn print_every(&mut self, interval: Duration, print: impl Fn(&str) + Send + 'static) {
        let (end, ended) = channel();
        let state = self.state.clone();
        self.lines = Some(end);
        thread::spawn(move || {
            while ended.recv_timeout(interval) == Err(RecvTimeoutError::Timeout) {
                print(&state.lock().line());
            }
        });
    }

    pub fn start(&self, of: usize) {
        self.state.lock().of = of;
        self.bar.set_length(of as u64);
        self.bar.tick();
    }

    /// Prints a line while it runs.
    pub fn say(&self, line: &str) {
        match self.lines {
            // Nobody may read it.
            Some(_) => drop(writeln!(std::io::stderr().lock(), "{line}")),
            None => self.bar.println(line),
        }
    }

    /// Records a finished item.
    pub fn done(&self, wrong: bool, result: Option<&impl Serialize>) {
        let mut state = self.state.lock();
        state.done += 1;
        state.wrong += usize::from(wrong);
        if let (Some(result), Some((path, file))) = (result, &mut state.log) {
            // A single write, so that an interrupted run leaves complete lines.
            let line = serde_json::to_string(result).map_err(std::io::Error::from);
            let written = line.and_then(|line| file.write_all((line + "\n").as_bytes()));
            if let Err(error) = written {
                let message = cannot_write(path, &error);
                state.log = None;
                state.failed = Some(message);
            }
        }
        if state.wrong > 0 {
            self.bar.set_message(format!("{} wrong", state.wrong));
        }
        self.bar.inc(1);
    }

    pub fn finish(mut self) -> Result<(), String> {
        self.lines.take();
        self.bar.finish_and_clear();
        self.state.lock().failed.take().map_or(Ok(()), Err)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_while_it_runs_and_end_with_it() {
        let (printed, lines) = channel();
        let mut follow = Follow::with(ProgressDrawTarget::hidden(), None);
        follow.start(3);
        follow.done(true, None::<&()>);
        follow.done(false, None::<&()>);
        follow.print_every(Duration::from_millis(5), move |line| {
            let _ = printed.send(line.to_owned());
        });
        let wait = Duration::from_secs(60);
        assert_eq!(lines.recv_timeout(wait).as_deref(), Ok("2 of 3, 1 wrong"));
        assert!(lines.recv_timeout(wait).is_ok());
        follow.finish().expect("no log to write");
        // The thread ends, and its end of the channel with it.
        while lines.recv_timeout(wait).is_ok() {}
        assert_eq!(lines.recv_timeout(wait), Err(RecvTimeoutError::Disconnected));
    }
}
