//! Cancellation by Ctrl-C and other signals.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
use signal_hook::consts::SIGHUP;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::output::{self, Failure};
use urdd_directory::cancellation::Cancellation;
use urdd_source::process;

/// A shell adds this to a signal's number to form an exit status.
const BY_SIGNAL: i32 = 128;

/// The signals that request termination. Includes the hangup of a closed terminal, unless the user ignores it
/// (`nohup`).
fn asking() -> Vec<i32> {
    let mut signals = vec![SIGINT, SIGTERM];
    #[cfg(unix)]
    if is_default(SIGHUP) {
        signals.push(SIGHUP);
    }
    signals
}

/// Whether a signal has its default action in this process, according to Linux's `/proc`.
#[cfg(unix)]
fn is_default(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mut masks = ["SigIgn:", "SigCgt:"].iter().map(|key| {
        let line = status.lines().find_map(|line| line.strip_prefix(key))?;
        u64::from_str_radix(line.trim(), 16).ok()
    });
    masks.all(|mask| mask.is_some_and(|mask| mask & (1 << (signal - 1)) == 0))
}

/// Runs a command that a signal can stop; `stopped` is what is said then. The processes that it starts end with it.
pub(super) fn run(
    stopped: Option<&str>,
    work: impl FnOnce(&Signals) -> Result<u8, Failure>,
) -> Result<u8, Failure> {
    let signals = Signals::listen()?;
    process::adopt_orphans();
    let result = work(&signals);
    let Some(status) = signals.status() else { return result };
    stopped.into_iter().for_each(output::error);
    Ok(status)
}

/// The signals that request termination. The first one cancels the work at the next safe point; the second one ends the
/// process immediately.
pub(super) struct Signals {
    flag: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
}

impl Signals {
    /// Starts to listen.
    ///
    /// # Errors
    /// If the operating system has no such signals.
    pub(super) fn listen() -> io::Result<Self> {
        let signals = Signals { flag: Arc::default(), number: Arc::default() };
        for signal in asking() {
            // The order matters: at the first signal, the flag must not be set yet.
            flag::register_conditional_shutdown(
                signal,
                BY_SIGNAL + signal,
                Arc::clone(&signals.flag),
            )?;
            flag::register(signal, Arc::clone(&signals.flag))?;
            let number = usize::try_from(signal).unwrap_or_default();
            flag::register_usize(signal, Arc::clone(&signals.number), number)?;
        }
        Ok(signals)
    }

    /// The cancellation, to pass to the work.
    pub(super) fn cancellation(&self) -> Cancellation {
        Cancellation::of(Arc::clone(&self.flag))
    }

    /// The exit status, if a signal was received.
    pub(super) fn status(&self) -> Option<u8> {
        let number = i32::try_from(self.number.load(Ordering::Relaxed)).ok()?;
        let status = u8::try_from(BY_SIGNAL + number).ok()?;
        (number != 0).then_some(status)
    }
}
