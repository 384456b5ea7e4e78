//! Progress of a run, and its log.

use std::fs::File;
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use parking_lot::Mutex;
use serde::Serialize;

/// Time between two lines where standard error is not a terminal.
const INTERVAL: Duration = Duration::from_secs(10);

/// The message for a file that cannot be written.
pub fn cannot_write(file: &Path, error: &std::io::Error) -> String {
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
    /// Number of items to run.
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

    /// Sets the number of items to run.
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

    /// Ends the run.
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
