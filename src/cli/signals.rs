//! Ctrl-C and other wishes to stop.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
use signal_hook::consts::SIGHUP;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use urdd_directory::cancellation::Cancellation;

/// What a shell adds to the number of a signal to make an exit status of it.
const BY_SIGNAL: i32 = 128;

/// The signals that ask to stop; a terminal that is closed too, but not where the user had that ignored (`nohup`).
fn asking() -> Vec<i32> {
    let mut signals = vec![SIGINT, SIGTERM];
    #[cfg(unix)]
    if is_default(SIGHUP) {
        signals.push(SIGHUP);
    }
    signals
}

/// Whether a signal does to this process what it usually does, as far as Linux says so.
#[cfg(unix)]
fn is_default(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mut masks = ["SigIgn:", "SigCgt:"].iter().map(|key| {
        let line = status.lines().find_map(|line| line.strip_prefix(key))?;
        u64::from_str_radix(line.trim(), 16).ok()
    });
    masks.all(|mask| mask.is_some_and(|mask| mask & (1 << (signal - 1)) == 0))
}

/// The signals that ask this process to stop. The first is a wish, and work stops where it leaves
/// nothing half done; the second ends the process at once.
pub(super) struct Signals {
    flag: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
}

impl Signals {
    /// Listens from now on.
    ///
    /// # Errors
    /// If the operating system has no such signals.
    pub(super) fn listen() -> io::Result<Self> {
        let signals = Signals {
            flag: Arc::default(),
            number: Arc::default(),
        };
        for signal in asking() {
            // In this order: the first signal finds the flag not set yet.
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

    /// The wish to stop, for whoever works.
    pub(super) fn cancellation(&self) -> Cancellation {
        Cancellation::of(Arc::clone(&self.flag))
    }

    /// The exit status, where a signal came.
    pub(super) fn status(&self) -> Option<u8> {
        let number = i32::try_from(self.number.load(Ordering::Relaxed)).ok()?;
        let status = u8::try_from(BY_SIGNAL + number).ok()?;
        (number != 0).then_some(status)
    }
}
