//! Generates URDDs for many robots, and continues after a failed one.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use urdd_directory::cancellation::Cancellation;
use urdd_directory::watched::{map_robots, watched};

use super::error::GenerateError;
use super::robot::{Generated, generate};
use super::settings::{Progress, Settings};
use urdd_source::robots::Job;

/// One of `n` shards of a batch: every n-th robot. The names are those of the whole batch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// The number of this shard, from 1.
    pub number: usize,
    /// The number of shards.
    pub of: usize,
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parse = || {
            let (number, of) = text.split_once('/')?;
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (number >= 1 && number <= of).then_some(Shard { number, of })
        };
        parse().ok_or_else(|| "write i/n with i from 1 to n, such as 2/8".to_owned())
    }
}

impl Shard {
    /// The jobs of this shard.
    pub fn of(self, jobs: Vec<Job>) -> Vec<Job> {
        let mine = jobs.into_iter().enumerate().filter(|(idx, _)| idx % self.of == self.number - 1);
        mine.map(|(_, job)| job).collect()
    }
}

/// Receives the progress and results of a batch.
pub trait Observer: Sync {
    /// A robot is started. The returned value receives the progress of its modules.
    fn begin(&self, job: &Job) -> Box<dyn Progress>;
    /// A robot is finished. Calls come in the order of the batch.
    fn done(&self, job: &Job, outcome: &Result<Generated, GenerateError>);
}

/// Generates a URDD for each job in `folder`, under the job's name, on the threads of the current pool. Returns the
/// number of failures. A panic (a bug in this program) counts as a failure and does not stop the batch. After
/// cancellation no further robot is started.
pub fn run(jobs: &[Job], folder: &Path, settings: &Settings, observer: &dyn Observer) -> usize {
    // Outcomes that wait for earlier ones.
    let waiting = Mutex::new((0, BTreeMap::new()));
    let one = |(idx, job): &(usize, &Job)| {
        if settings.source.cancellation.is_cancelled() {
            return 0;
        }
        let progress = observer.begin(job);
        let target = folder.join(&job.name);
        let own = Settings { source: job.settings(&settings.source), ..settings.clone() };
        let source = job.source.clone();
        let make = move |own: &Settings| generate(&source, &target, own, &*progress);
        let outcome = within_limits(&job.source, &own, make);
        let failed = usize::from(outcome.is_err());
        let mut waiting = waiting.lock().unwrap_or_else(PoisonError::into_inner);
        let (next, outcomes) = &mut *waiting;
        outcomes.insert(*idx, outcome);
        while let Some(outcome) = outcomes.remove(next) {
            observer.done(&jobs[*next], &outcome);
            *next += 1;
        }
        failed
    };
    let numbered: Vec<(usize, &Job)> = jobs.iter().enumerate().collect();
    map_robots(&settings.source.cancellation, &numbered, one).into_iter().sum()
}

/// As [`caught`], within the limits of a robot, if the run has any.
///
/// # Errors
/// Those of [`caught`]; [`GenerateError::Limit`] for a robot beyond its limits.
pub fn within_limits<T: Send + 'static>(
    source: &Path,
    settings: &Settings,
    make: impl FnOnce(&Settings) -> Result<T, GenerateError> + Send + 'static,
) -> Result<T, GenerateError> {
    let (own, mut settings) = (source.to_owned(), settings.clone());
    let run = settings.source.cancellation.clone();
    let file = source.display().to_string();
    let work = move |cancellation: &Cancellation| {
        settings.source.cancellation = cancellation.clone();
        caught(&own, || make(&settings))
    };
    watched(&run, &file, work)
        .unwrap_or_else(|limit| Err(GenerateError::Limit { file: file.clone(), limit }))
}

/// Runs `make` for a source and turns a panic into an error.
///
/// # Errors
/// Those of `make`; [`GenerateError::Internal`] for a panic.
pub fn caught<T>(
    source: &Path,
    make: impl FnOnce() -> Result<T, GenerateError>,
) -> Result<T, GenerateError> {
    catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|crash| {
        let words = crash.downcast_ref::<String>().map(String::as_str);
        let words = words.or_else(|| crash.downcast_ref::<&str>().copied());
        let file = source.display().to_string();
        Err(GenerateError::internal(&file, words.unwrap_or("it crashed")))
    })
}
