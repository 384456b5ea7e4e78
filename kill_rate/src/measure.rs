//! Applies the mutations of each URDD one by one, and runs the validator on each.

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use thiserror::Error;

use super::mutation::Mutation;
use super::original::{Original, OriginalError};
use super::outcome::{Outcome, Trial, judge};
use super::plan::{Judge, Plan};
use super::result::Measured;
use super::sample;
use super::workbench::Workbench;
use super::{documents, file_changes, mesh_changes, module_changes, source_changes};
use urdd_directory::discover::{DiscoverError, Found, discover};
use urdd_validate::code::Code;

/// Why nothing can be measured.
#[derive(Debug, Error)]
pub enum MeasureError {
    /// No URDD was found at a path.
    #[error(transparent)]
    Discover(#[from] DiscoverError),
    /// A URDD that cannot be read.
    #[error("{name}: {error}")]
    Original {
        /// The URDD.
        name: String,
        /// What is wrong.
        error: OriginalError,
    },
    /// A URDD has findings before any mutation.
    #[error(
        "{name}: there are findings before anything is changed ({}); `urdd validate` tells them, and only a URDD without \
         any can be measured with", codes.iter().map(|code| code.as_str()).collect::<Vec<_>>().join(", ")
    )]
    HasFindings {
        /// The URDD.
        name: String,
        /// The rules with findings.
        codes: Vec<Code>,
    },
    /// The temporary copy cannot be written.
    #[error("the temporary copy of a URDD cannot be written: {0}")]
    Copy(#[from] io::Error),
}

/// Measures every URDD at or below each of the paths, in that order. After each mutation, calls `progress` with the
/// URDD's name, the number done and the total.
///
/// # Errors
/// If there is nothing to measure with, or a URDD has findings before any mutation.
pub fn measure<P: AsRef<Path>>(
    paths: &[P],
    judge: &Judge,
    plan: &Plan,
    progress: &(dyn Fn(&str, usize, usize) + Sync),
) -> Result<Vec<Measured>, MeasureError> {
    let mut found: Vec<Found> = Vec::new();
    for path in paths {
        found.extend(discover(path.as_ref())?);
    }
    let mut originals = Vec::with_capacity(found.len());
    for found in &found {
        originals.push(original(&found.name, &found.path, judge)?);
    }
    let mut measured = Vec::with_capacity(found.len());
    for (index, found) in found.iter().enumerate() {
        let this = &originals[index];
        let others = originals[index + 1..].iter().chain(&originals[..index]);
        let mutations = mutations(this, &others.collect::<Vec<_>>(), plan);
        let told = |done| progress(&found.name, done, mutations.len());
        let trials = try_all(this, &mutations, judge, plan, &told)?;
        measured.push(Measured::new(found.name.clone(), trials));
    }
    Ok(measured)
}

fn original(name: &str, path: &Path, by: &Judge) -> Result<Original, MeasureError> {
    let failed = |codes| MeasureError::HasFindings { name: name.to_owned(), codes };
    for settings in std::iter::once(&by.plain).chain(&by.deep) {
        match judge(path, by.rules, settings) {
            Outcome::Missed => {}
            Outcome::Noticed(codes) | Outcome::Warned(codes) => return Err(failed(codes)),
            Outcome::Crashed(code) => return Err(failed(vec![code])),
            Outcome::Unreadable => return Err(failed(Vec::new())),
        }
    }
    Original::read(path).map_err(|error| MeasureError::Original { name: name.to_owned(), error })
}

fn mutations(original: &Original, others: &[&Original], plan: &Plan) -> Vec<Mutation> {
    let mut lists = documents::mutations(original, plan);
    lists.extend(source_changes::mutations(original, plan));
    lists.extend(file_changes::mutations(original, plan));
    lists.extend(mesh_changes::mutations(original, plan));
    lists.extend(module_changes::mutations(original, others));
    let mut by_module: BTreeMap<String, Vec<Vec<Mutation>>> = BTreeMap::new();
    for list in lists {
        let Some(first) = list.first() else { continue };
        let module = &first.description.module;
        if plan.modules.is_empty() || plan.modules.contains(module) {
            by_module.entry(module.clone()).or_default().push(list);
        }
    }
    let of_module = |lists| sample::in_turn(lists, usize::MAX);
    let modules = by_module.into_values().map(of_module).collect();
    let mut chosen = sample::in_turn(modules, plan.limit.unwrap_or(usize::MAX));
    // A stable sort: mutations of a field keep the order in which they were drawn.
    chosen.sort_by(|a, b| {
        let key = |mutation: &Mutation| {
            let description = &mutation.description;
            let modules = original.documents.iter();
            let place = modules.take_while(|known| known.name != description.module);
            (place.count(), description.field.clone(), description.target)
        };
        key(a).cmp(&key(b))
    });
    chosen
}

/// Every effective mutation, in order, with its outcome.
fn try_all(
    original: &Original,
    mutations: &[Mutation],
    judge: &Judge,
    plan: &Plan,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Trial>, MeasureError> {
    let threads = plan.threads.unwrap_or_else(rayon::current_num_threads);
    let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let trials: Mutex<Vec<(usize, Trial)>> = Mutex::new(Vec::new());
    let work = || -> Result<(), MeasureError> {
        let workbench = Workbench::new(original)?;
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(mutation) = mutations.get(index) else {
                return Ok(());
            };
            if let Some(trial) = try_one(original, mutation, judge, &workbench)? {
                lock(&trials).push((index, trial));
            }
            progress(done.fetch_add(1, Ordering::Relaxed) + 1);
        }
    };
    // A separate pool for each copy, so that a waiting worker does not take over another's work.
    let alone = || match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        Err(_) => work(),
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(alone)).collect();
        for worker in workers {
            match worker.join() {
                Ok(result) => result?,
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        Ok::<(), MeasureError>(())
    })?;
    let mut trials = std::mem::take(&mut *lock(&trials));
    trials.sort_by_key(|(index, _)| *index);
    Ok(trials.into_iter().map(|(_, trial)| trial).collect())
}

fn try_one(
    original: &Original,
    mutation: &Mutation,
    by: &Judge,
    workbench: &Workbench,
) -> Result<Option<Trial>, MeasureError> {
    let Some((files, change)) = mutation.make(original) else {
        return Ok(None);
    };
    let trial = workbench.with(&files, |path| {
        let plain = judge(path, by.rules, &by.plain);
        let deep = by.deep.as_ref().map(|settings| match plain {
            Outcome::Missed | Outcome::Warned(_) => judge(path, by.rules, settings),
            _ => plain.clone(),
        });
        Trial { change, plain, deep }
    })?;
    Ok(Some(trial))
}

fn lock<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}
