//! Configurations that a program shows: pages follow them.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::Deserialize;
use serde_json::json;

use crate::collection::Shown;
use crate::reply::{Body, Reply};
use urdd_directory::cancellation::Cancellation;

/// The most values of a configuration of a robot that is not generated yet.
const MAX_VALUES: usize = 100_000;
/// Pause after which a page without news hears that the server is still there.
const PAUSE: Duration = Duration::from_millis(500);

/// The configuration that a program showed last. Pages that are slower than the program miss those between.
#[derive(Debug, Default)]
pub struct States {
    last: Mutex<(u64, Arc<str>)>,
    changed: Condvar,
}

/// What a program sends.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sent {
    q: Vec<f64>,
}

/// Takes a configuration for a robot from a request.
pub fn take(robot: &Shown, body: &[u8]) -> Reply {
    let Ok(Sent { q }) = serde_json::from_slice::<Sent>(body) else {
        return Reply::failure(400, "expected {\"q\": [...]}, a number for each DOF\n");
    };
    // Of one that is not generated yet, nothing is known.
    let dofs = robot.open().ok().and_then(|(_, opened)| Some(opened.robot.dof_names().ok()?.len()));
    match dofs {
        Some(dofs) if dofs != q.len() => {
            let found = q.len();
            let why = format!("expected one value for each DOF, so {dofs}; found {found}\n");
            Reply::failure(400, why)
        }
        None if q.len() > MAX_VALUES => Reply::failure(400, "too many values\n"),
        _ => {
            robot.states.set(&q);
            Reply::nothing()
        }
    }
}

impl States {
    /// Shows a configuration: one value for each DOF, rad or m.
    pub fn set(&self, configuration: &[f64]) {
        let mut last = self.last();
        *last = (last.0 + 1, format!("{}\n", json!({ "q": configuration })).into());
        self.changed.notify_all();
    }

    /// Whether a program has shown any.
    pub(crate) fn are_sent(&self) -> bool {
        self.last().0 > 0
    }

    /// Each configuration as a line of JSON, from the last one on, and empty lines meanwhile.
    pub(crate) fn stream(self: &Arc<Self>, cancellation: &Cancellation) -> Reply {
        let (states, cancellation) = (Arc::clone(self), cancellation.clone());
        let mut seen = 0;
        let next = move || {
            let last = states.last();
            let waited =
                states.changed.wait_timeout_while(last, PAUSE, |(count, _)| *count == seen);
            let (last, _) = waited.unwrap_or_else(PoisonError::into_inner);
            if cancellation.is_cancelled() {
                return None;
            }
            let news = last.0 != seen;
            seen = last.0;
            Some(if news { Arc::clone(&last.1) } else { "\n".into() })
        };
        Reply {
            status: 200,
            media_type: "application/jsonl",
            brotli: false,
            body: Body::Lines(Box::new(next)),
        }
    }

    fn last(&self) -> MutexGuard<'_, (u64, Arc<str>)> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
