//! The thread pool.

use std::sync::{Arc, Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// A pool, and the settings it was created for.
struct Made {
    /// The process id: a child of `fork` has none of its parent's threads.
    process: u32,
    /// The requested number; `None`: one for each processor.
    wanted: Option<usize>,
    pool: Arc<ThreadPool>,
}

static WANTED: Mutex<Option<usize>> = Mutex::new(None);
static MADE: Mutex<Option<Made>> = Mutex::new(None);

/// The pool of this process. All parallel work runs in it, never in rayon's global pool, which is unusable after a
/// `fork`.
pub fn pool() -> PyResult<Arc<ThreadPool>> {
    let wanted = *WANTED.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    let mut made = MADE.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(made) = &*made
        && made.process == process
        && made.wanted == wanted
    {
        return Ok(Arc::clone(&made.pool));
    }
    let mut builder = ThreadPoolBuilder::new().thread_name(|k| format!("urdd-{k}"));
    if let Some(wanted) = wanted {
        builder = builder.num_threads(wanted);
    }
    let pool = builder.build();
    let pool = Arc::new(pool.map_err(|error| {
        let count = wanted.map_or_else(String::new, |count| format!("{count} "));
        PyRuntimeError::new_err(format!("{count}threads cannot be started: {error}"))
    })?);
    let old = made.replace(Made { process, wanted, pool: Arc::clone(&pool) });
    if let Some(old) = old
        && old.process != process
    {
        // Its threads exist only in the parent, so dropping the pool would wait forever.
        std::mem::forget(old);
    }
    Ok(pool)
}

/// Sets the number of threads. `None`: one for each processor, or the value of `RAYON_NUM_THREADS`.
#[pyfunction]
#[pyo3(signature = (count=None))]
pub fn set_num_threads(count: Option<isize>) -> PyResult<()> {
    let count = count.map(|count| usize::try_from(count).unwrap_or(0));
    if count == Some(0) {
        return Err(pyo3::exceptions::PyValueError::new_err(
            "the number of threads must be at least 1; None is one for each processor",
        ));
    }
    let wanted = || WANTED.lock().unwrap_or_else(PoisonError::into_inner);
    let before = std::mem::replace(&mut *wanted(), count);
    // Creates the pool now, to report an error here instead of when work begins.
    let made = pool();
    if made.is_err() {
        *wanted() = before;
    }
    made.map(drop)
}

/// The number of threads.
#[pyfunction]
pub fn num_threads() -> PyResult<usize> {
    Ok(pool()?.current_num_threads())
}
