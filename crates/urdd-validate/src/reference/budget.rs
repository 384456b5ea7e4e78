//! Work that a rule may do, counted in operations, so that the result is the same on every machine.

use std::sync::atomic::{AtomicU64, Ordering};

use urdd_findings::skip::SkipReason;

/// The work of a rule, the sum over all threads.
pub struct Budget {
    left: u64,
    done: AtomicU64,
    reason: SkipReason,
}

impl Budget {
    /// This many operations; the reason is given where they are not enough.
    pub fn of(operations: u64, reason: SkipReason) -> Self {
        Budget { left: operations, done: AtomicU64::new(0), reason }
    }

    /// Adds operations. The sum of all of them decides, whatever their order: where it is too large, some call fails.
    ///
    /// # Errors
    /// If the sum is larger than allowed.
    pub fn spend(&self, operations: u64) -> Result<(), SkipReason> {
        let before = self.done.fetch_add(operations.min(self.left + 1), Ordering::Relaxed);
        match before.saturating_add(operations) > self.left {
            true => Err(self.reason.clone()),
            false => Ok(()),
        }
    }
}
