//! What a program shows of a robot: configurations, a path, obstacles. Pages follow it.

use std::sync::Arc;
use std::time::Duration;

use parking_lot::{Condvar, Mutex};
use serde_json::json;

use crate::reply::{Body, Reply};
use urdd_directory::cancellation::Cancellation;

/// Pause after which a page without news hears that the server is still there.
const PAUSE: Duration = Duration::from_millis(500);

/// What a program showed last. Pages that are slower than the program miss what was between.
#[derive(Debug, Default)]
pub struct States {
    last: Mutex<Last>,
    changed: Condvar,
}

/// How often something was shown, and the lines that were last: `around` the robot, and its configuration.
#[derive(Debug, Default, Clone)]
struct Last {
    count: u64,
    around: Option<(u64, Arc<str>)>,
    configuration: Option<(u64, Arc<str>)>,
}

impl States {
    /// Shows a configuration: one value for each DOF, rad or m.
    pub fn set(&self, configuration: &[f64]) {
        let line = json!({ "q": configuration }).to_string();
        self.put(&line, |last| &mut last.configuration);
    }

    /// Shows what is around a robot, in place of what was: a JSON object with the keys `world` and `path`, as
    /// `page/src/showing.ts` has them.
    pub fn show(&self, around: &str) {
        self.put(around, |last| &mut last.around);
    }

    fn put(&self, text: &str, place: impl Fn(&mut Last) -> &mut Option<(u64, Arc<str>)>) {
        // A line feed in JSON is a blank.
        let line = format!("{}\n", text.replace(['\n', '\r'], " "));
        let mut last = self.last.lock();
        last.count += 1;
        let count = last.count;
        *place(&mut last) = Some((count, line.into()));
        self.changed.notify_all();
    }

    /// Whether a program has shown any.
    pub(crate) fn are_sent(&self) -> bool {
        self.last.lock().count > 0
    }

    /// Each line of JSON, from the last ones on, and empty lines meanwhile.
    pub(crate) fn stream(self: &Arc<Self>, cancellation: &Cancellation) -> Reply {
        let (states, cancellation) = (Arc::clone(self), cancellation.clone());
        let mut seen = 0;
        let next = move || {
            let mut last = states.last.lock();
            states.changed.wait_while_for(&mut last, |last| last.count == seen, PAUSE);
            if cancellation.is_cancelled() {
                return None;
            }
            let news = [&last.around, &last.configuration].into_iter().flatten();
            let oldest = news.filter(|(count, _)| *count > seen).min_by_key(|(count, _)| *count);
            let Some((count, line)) = oldest else { return Some("\n".into()) };
            seen = *count;
            Some(Arc::clone(line))
        };
        Reply::ok("application/jsonl", Body::Lines(Box::new(next)))
    }
}
