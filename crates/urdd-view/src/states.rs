//! Configurations that a program shows: pages follow them.

use std::sync::Arc;
use std::time::Duration;

use parking_lot::{Condvar, Mutex};
use serde_json::json;

use crate::reply::{Body, Reply};
use urdd_directory::cancellation::Cancellation;

/// Pause after which a page without news hears that the server is still there.
const PAUSE: Duration = Duration::from_millis(500);

/// The configuration that a program showed last. Pages that are slower than the program miss those between.
#[derive(Debug, Default)]
pub struct States {
    last: Mutex<(u64, Arc<str>)>,
    changed: Condvar,
}

impl States {
    /// Shows a configuration: one value for each DOF, rad or m.
    pub fn set(&self, configuration: &[f64]) {
        let mut last = self.last.lock();
        *last = (last.0 + 1, format!("{}\n", json!({ "q": configuration })).into());
        self.changed.notify_all();
    }

    /// Whether a program has shown any.
    pub(crate) fn are_sent(&self) -> bool {
        self.last.lock().0 > 0
    }

    /// Each configuration as a line of JSON, from the last one on, and empty lines meanwhile.
    pub(crate) fn stream(self: &Arc<Self>, cancellation: &Cancellation) -> Reply {
        let (states, cancellation) = (Arc::clone(self), cancellation.clone());
        let mut seen = 0;
        let next = move || {
            let mut last = states.last.lock();
            states.changed.wait_while_for(&mut last, |(count, _)| *count == seen, PAUSE);
            if cancellation.is_cancelled() {
                return None;
            }
            let news = last.0 != seen;
            seen = last.0;
            Some(if news { Arc::clone(&last.1) } else { "\n".into() })
        };
        Reply::ok("application/jsonl", Body::Lines(Box::new(next)))
    }
}
