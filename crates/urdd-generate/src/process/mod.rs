//! Running a program that is not ours: for a limited time, and whatever it started ends with it.
//!
//! What ends with a program, whether it ended by itself or was stopped:
//!
//! - Linux: its process group; all processes that descend from it; all that have its mark in their environment, which
//!   reaches those that made a session of their own (`setsid`) and whose parents have ended. Where [`adopt_orphans`] was
//!   called, also those that took the mark away, with the last program that runs.
//! - other Unix systems: its process group.
//! - Windows: its job object, which holds all that it starts.

#[cfg(target_os = "linux")]
mod linux;
#[cfg(not(target_os = "linux"))]
mod other;

use std::io;
use std::process::{ChildStderr, ChildStdout, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

#[cfg(target_os = "linux")]
use linux::Tree;
#[cfg(not(target_os = "linux"))]
use other::Tree;
use urdd_directory::cancellation::Cancellation;

/// How often a running program is looked at.
pub const PAUSE: Duration = Duration::from_millis(5);

/// A program that runs. When this is dropped, the program and all that it started ends.
pub struct Running(Tree);

/// Why waiting for a program ended. All that it started has ended too.
#[derive(Debug)]
pub enum Ended {
    /// It ended by itself.
    Itself(ExitStatus),
    /// It was stopped at the time limit.
    TimeLimit,
    /// It was stopped, since the caller has seen enough.
    Enough,
    /// It was stopped, since this run is to stop.
    Cancelled,
}

impl Running {
    /// Starts a program, without standard input, and with pipes for what it writes.
    ///
    /// # Errors
    /// Where it cannot be started.
    pub fn start(mut command: Command) -> io::Result<Running> {
        command
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        Tree::start(command).map(Running)
    }

    /// Its standard output and standard error, the first time.
    pub fn streams(&mut self) -> (Option<ChildStdout>, Option<ChildStderr>) {
        self.0.streams()
    }

    /// Waits until it ends, but no longer than `limit`; until `is_enough`, which is asked again and again; and until it is
    /// asked to stop.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn wait(
        mut self,
        limit: Duration,
        cancellation: &Cancellation,
        mut is_enough: impl FnMut() -> bool,
    ) -> io::Result<Ended> {
        let start = Instant::now();
        loop {
            if cancellation.is_cancelled() {
                return Ok(Ended::Cancelled);
            }
            if is_enough() {
                return Ok(Ended::Enough);
            }
            match self.0.try_wait()? {
                Some(status) => return Ok(Ended::Itself(status)),
                None if start.elapsed() >= limit => return Ok(Ended::TimeLimit),
                None => thread::sleep(PAUSE),
            }
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// Makes this process the one that adopts what its programs leave behind, so that it ends with them too (Linux). For a
/// program, not for a library: every child of this process that was not started here counts as such.
pub fn adopt_orphans() {
    #[cfg(target_os = "linux")]
    linux::adopt_orphans();
}
