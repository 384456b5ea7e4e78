//! Runs external programs with a time limit. All processes that a program starts end with it.
//!
//! What ends with a program, whether it exits or is stopped:
//!
//! - Linux: its process group; all its descendants; all processes with its mark in their environment, which includes
//!   those in a session of their own (`setsid`) whose parents have ended. After [`adopt_orphans`], also those that
//!   removed the mark; they end with the last running program.
//! - other Unix systems: its process group.
//! - Windows: its job object, which contains all processes that it starts.

#[cfg(target_os = "linux")]
mod linux;
#[cfg(not(target_os = "linux"))]
mod other;

use std::process::{ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};
use std::{io, thread};

use urdd_directory::cancellation::Cancellation;

#[cfg(target_os = "linux")]
use linux::Tree;
#[cfg(not(target_os = "linux"))]
use other::Tree;

/// Polling interval for a running program.
pub const PAUSE: Duration = Duration::from_millis(5);

/// A running program. Dropping this ends the program and all processes that it started.
pub struct Running(Tree);

/// Why waiting for a program ended. All processes that it started have ended too.
#[derive(Debug)]
pub enum Ended {
    /// The program exited.
    Itself(ExitStatus),
    /// The program was stopped at the time limit.
    TimeLimit,
    /// The program was stopped because `is_enough` returned true.
    Enough,
    /// The program was stopped because of a cancellation.
    Cancelled,
}

impl Running {
    /// Starts a program without standard input, and with pipes for its output.
    ///
    /// # Errors
    /// If it cannot be started.
    pub fn start(mut command: Command) -> io::Result<Running> {
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        Tree::start(command).map(Running)
    }

    /// Starts a program as [`Running::start`] does, with a pipe for its standard input.
    ///
    /// # Errors
    /// If it cannot be started.
    pub fn start_with_input(mut command: Command) -> io::Result<(Running, ChildStdin)> {
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut tree = Tree::start(command)?;
        let input = tree.input().ok_or(io::ErrorKind::BrokenPipe)?;
        Ok((Running(tree), input))
    }

    /// Its standard output and standard error; only the first call returns them.
    pub fn streams(&mut self) -> (Option<ChildStdout>, Option<ChildStderr>) {
        self.0.streams()
    }

    /// Waits until the program exits, `limit` is over, `is_enough` (polled repeatedly) returns true, or `cancellation`
    /// is cancelled.
    ///
    /// # Errors
    /// The operating system's error.
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

/// Ends the programs that run, for a process that ends at once. Elsewhere than on Linux, and without their descendants in other
/// groups, they end by themselves.
pub fn end_all() {
    #[cfg(target_os = "linux")]
    linux::end_all();
}

/// Makes this process adopt the orphans of its programs, so that they end too (Linux). For executables, not libraries:
/// every child of this process that was not started here counts as such an orphan.
pub fn adopt_orphans() {
    #[cfg(target_os = "linux")]
    linux::adopt_orphans();
}
