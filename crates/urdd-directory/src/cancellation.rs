//! Cancellation of long operations: `generate`, `urdd_validate`, and batch queries in `urdd_robot`.
//!
//! The caller keeps a clone of a [`Cancellation`]. The worker checks it regularly, stops in a consistent state and
//! returns an error. The library does not install signal handlers; `urdd generate` does.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use thiserror::Error;

/// A shared cancellation flag. Clones share it. A check is one atomic load.
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

/// The operation was cancelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("stopped before it was finished")]
pub struct Cancelled;

impl Cancellation {
    /// A cancellation that uses an existing flag, such as one set by a signal handler.
    pub fn of(flag: Arc<AtomicBool>) -> Self {
        Cancellation(flag)
    }

    /// Requests cancellation.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether cancellation was requested.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Returns an error after cancellation, for use with `?`.
    ///
    /// # Errors
    /// If cancellation was requested.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }
}
