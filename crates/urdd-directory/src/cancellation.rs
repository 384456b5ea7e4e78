//! Stopping what takes long: `generate`, `urdd-validate`, and questions about many configurations in `urdd-robot`.
//!
//! Whoever wants to stop keeps a clone of a [`Cancellation`]; whoever works asks it now and then, stops where nothing is
//! half done, and says so by an error. The library installs no signal handlers: `urdd generate` does.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use thiserror::Error;

/// A wish to stop, which whoever works asks for now and then. Clones share it. Asking is one read of memory.
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

/// It was asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("stopped before it was done")]
pub struct Cancelled;

impl Cancellation {
    /// One that is set elsewhere too, as by a signal.
    pub fn of(flag: Arc<AtomicBool>) -> Self {
        Cancellation(flag)
    }

    /// Asks to stop.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether to stop.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Stops by `?`.
    ///
    /// # Errors
    /// Where it was asked to stop.
    pub fn check(&self) -> Result<(), Cancelled> {
        match self.is_cancelled() {
            true => Err(Cancelled),
            false => Ok(()),
        }
    }
}
