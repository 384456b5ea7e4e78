//! Cancellation of long operations, and limits of what each robot of a run may take.
//!
//! The caller keeps a clone of a [`Cancellation`]. The worker checks it regularly, stops in a consistent state and
//! returns an error. The library does not install signal handlers and measures nothing; the program `urdd` does.

use std::ops::Deref;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use thiserror::Error;

/// A shared cancellation flag. Clones share it. A check is one atomic load, or two for a robot with limits.
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<State>);

#[derive(Debug, Default)]
struct State {
    flag: Arc<AtomicBool>,
    /// What it is a part of, and is cancelled with.
    run: Option<Cancellation>,
    /// The limit that it was cancelled for, and when.
    exceeded: OnceLock<(Limit, Instant)>,
    /// Whether nobody waits any longer for the work to stop.
    is_given_up: AtomicBool,
    /// The robots that are worked on, if each has limits.
    robots: Option<Mutex<Vec<RobotInWork>>>,
}

/// The operation was cancelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("stopped before it was finished")]
pub struct Cancelled;

/// What a robot took more of than it may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum Limit {
    #[error("not finished within {} s, the limit of --max-time; raise it for a robot that you trust", .0.as_secs_f64())]
    Time(Duration),
    #[error(
        "more than {0} MB of memory, the limit of --max-memory; raise it for a robot that you trust"
    )]
    Memory(u64),
}

/// A robot that is worked on.
#[derive(Debug, Clone)]
pub struct RobotInWork {
    /// Its name, for messages.
    pub name: String,
    /// When the work began.
    pub since: Instant,
    /// Cancels the work on it alone.
    pub cancellation: Cancellation,
}

impl Cancellation {
    /// A cancellation that uses an existing flag, such as one set by a signal handler.
    pub fn of(flag: Arc<AtomicBool>) -> Self {
        Cancellation(Arc::new(State { flag, ..State::default() }))
    }

    /// As [`Cancellation::of`], of a run in which somebody watches what each robot takes: see
    /// [`Cancellation::in_work`].
    pub fn watched(flag: Arc<AtomicBool>) -> Self {
        Cancellation(Arc::new(State { flag, robots: Some(Mutex::default()), ..State::default() }))
    }

    /// Requests cancellation.
    pub fn cancel(&self) {
        self.0.flag.store(true, Ordering::Relaxed);
    }

    /// Whether cancellation was requested.
    pub fn is_cancelled(&self) -> bool {
        self.0.flag.load(Ordering::Relaxed)
            || self.0.run.as_ref().is_some_and(Cancellation::is_cancelled)
    }

    /// Returns an error after cancellation, for use with `?`.
    ///
    /// # Errors
    /// If cancellation was requested.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Requests cancellation because of a limit.
    pub fn exceed(&self, limit: Limit) {
        self.0.exceeded.get_or_init(|| (limit, Instant::now()));
        self.cancel();
    }

    /// The limit that it was cancelled for, and when.
    pub fn exceeded(&self) -> Option<(Limit, Instant)> {
        self.0.exceeded.get().copied()
    }

    /// Says that the work does not stop, and that whoever can leave it behind is to go on without it.
    pub fn give_up(&self) {
        self.0.is_given_up.store(true, Ordering::Relaxed);
    }

    /// Whether it was given up.
    pub fn is_given_up(&self) -> bool {
        self.0.is_given_up.load(Ordering::Relaxed)
    }

    /// Whether each robot of the run has limits. They are worked on one after the other then: who works on two at once does
    /// not know which of them takes the time.
    pub fn is_watched(&self) -> bool {
        self.0.robots.is_some()
    }

    /// Begins the work on a robot of the run: it is cancelled with the run, or alone, if it takes more than it may.
    pub fn robot(&self, name: &str) -> OneRobot {
        let Some(robots) = self.0.robots.as_ref().map(lock) else {
            return OneRobot { cancellation: self.clone(), run: None };
        };
        let state = State { run: Some(self.clone()), ..State::default() };
        let cancellation = Cancellation(Arc::new(state));
        let name = name.to_owned();
        let (since, own) = (Instant::now(), cancellation.clone());
        { robots }.push(RobotInWork { name, since, cancellation: own });
        OneRobot { cancellation, run: Some(self.clone()) }
    }

    /// The robots that are worked on now, if the run is watched.
    pub fn in_work(&self) -> Vec<RobotInWork> {
        self.0.robots.as_ref().map(|robots| lock(robots).clone()).unwrap_or_default()
    }
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The cancellation of one robot of a run; the work on it ends when this is dropped.
#[derive(Debug)]
pub struct OneRobot {
    cancellation: Cancellation,
    run: Option<Cancellation>,
}

impl OneRobot {
    /// The limit that it exceeded.
    pub fn limit(&self) -> Option<Limit> {
        self.exceeded().map(|(limit, _)| limit)
    }
}

impl Deref for OneRobot {
    type Target = Cancellation;

    fn deref(&self) -> &Cancellation {
        &self.cancellation
    }
}

impl Drop for OneRobot {
    fn drop(&mut self) {
        if let Some(robots) = self.run.as_ref().and_then(|run| run.0.robots.as_ref()) {
            let own = &self.cancellation.0;
            lock(robots).retain(|robot| !Arc::ptr_eq(&robot.cancellation.0, own));
        }
    }
}
