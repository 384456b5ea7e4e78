//! Work that a rule may do, counted in operations, so that the result is the same on every machine.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::skip;
use urdd_findings::skip::SkipReason;

/// Operations by default: about 10 seconds of one core.
const DEFAULT: u64 = 10_000_000_000;
/// The same with `--deep`: some minutes.
const DEEP: u64 = 400_000_000_000;

/// The work of a rule, the sum over all threads.
pub struct Budget {
    left: u64,
    deep: bool,
    done: AtomicU64,
}

impl Budget {
    /// `deep` allows more.
    pub fn new(deep: bool) -> Self {
        Budget::of(if deep { DEEP } else { DEFAULT }, deep)
    }

    /// This many operations.
    pub fn of(operations: u64, deep: bool) -> Self {
        Budget { left: operations, deep, done: AtomicU64::new(0) }
    }

    /// Adds operations. The sum of all of them decides, whatever their order: where it is too large, some call fails.
    ///
    /// # Errors
    /// If the sum is larger than allowed.
    pub fn spend(&self, operations: u64) -> Result<(), SkipReason> {
        let before = self.done.fetch_add(operations.min(self.left + 1), Ordering::Relaxed);
        match before.saturating_add(operations) > self.left {
            true => Err(skip::spheres_take_too_long(self.deep)),
            false => Ok(()),
        }
    }
}
