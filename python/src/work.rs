//! Long-running work: with the interpreter detached, on the thread pool, until Ctrl-C.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::panic::PanicException;
use pyo3::prelude::*;
use urdd_directory::cancellation::Cancellation;

use crate::threads::pool;

/// Polling interval for Ctrl-C.
const PAUSE: Duration = Duration::from_millis(20);

/// The start of a module, or a finished step: its name, the number of finished modules, and their total.
pub type Step = (String, usize, usize);

enum Word {
    Told(Step),
    Done(std::thread::Result<()>),
}

/// The channel on which work reports its progress.
pub struct Teller(Sender<Word>);

impl Teller {
    pub fn tell(&self, step: Step) {
        // The receiver may no longer exist.
        let _ = self.0.send(Word::Told(step));
    }
}

/// Runs a job. Ctrl-C cancels it, and is raised after it has stopped.
pub fn run<T: Send>(py: Python<'_>, job: impl FnOnce(&Cancellation) -> T + Send) -> PyResult<T> {
    run_and_tell(py, |_| Ok(()), move |cancellation, _| job(cancellation))
}

/// Like [`run`]; calls `hear` on the caller's thread with the job's steps. An error of `hear` cancels the job too.
pub fn run_and_tell<T: Send>(
    py: Python<'_>,
    mut hear: impl FnMut(Step) -> PyResult<()>,
    job: impl FnOnce(&Cancellation, &Teller) -> T + Send,
) -> PyResult<T> {
    let (mut job, mut answer) = (Some(job), None);
    supervise(py, &mut hear, &mut |cancellation, teller| {
        answer = job.take().map(|job| job(cancellation, teller));
    })?;
    answer.ok_or_else(no_answer)
}

/// A job that keeps its own answer.
type Job<'a> = &'a mut (dyn FnMut(&Cancellation, &Teller) + Send);

/// Waits for a job on the thread pool. Without a type of answer, it is compiled once and not for each.
fn supervise(
    py: Python<'_>,
    hear: &mut dyn FnMut(Step) -> PyResult<()>,
    job: Job<'_>,
) -> PyResult<()> {
    let cancellation = Cancellation::default();
    let (sender, receiver) = channel();
    let own = cancellation.clone();
    // A receiver can be moved between threads but not shared. The lock is never contended.
    let receiver = Mutex::new(receiver);
    let pool = pool()?;
    pool.in_place_scope(|scope| {
        scope.spawn(move |_| {
            let teller = Teller(sender);
            let outcome = catch_unwind(AssertUnwindSafe(|| job(&own, &teller)));
            let _ = teller.0.send(Word::Done(outcome));
        });
        let mut stopped: Option<PyErr> = None;
        loop {
            let word = py.detach(|| next(&receiver));
            let heard = match word {
                Ok(Word::Done(Ok(()))) => return stopped.map_or(Ok(()), Err),
                Ok(Word::Done(Err(panic))) => return Err(crash(&*panic)),
                Ok(Word::Told(step)) if stopped.is_none() => hear(step),
                Ok(Word::Told(_)) | Err(RecvTimeoutError::Timeout) => Ok(()),
                Err(RecvTimeoutError::Disconnected) => return Err(no_answer()),
            };
            if let Err(error) = heard.and_then(|()| py.check_signals()) {
                cancellation.cancel();
                stopped.get_or_insert(error);
            }
        }
    })
}

fn no_answer() -> PyErr {
    PyRuntimeError::new_err("the work ended without an answer")
}

fn next(receiver: &Mutex<Receiver<Word>>) -> Result<Word, RecvTimeoutError> {
    let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
    receiver.recv_timeout(PAUSE)
}

/// A panic as an exception.
fn crash(panic: &(dyn Any + Send)) -> PyErr {
    let words = panic.downcast_ref::<String>().cloned();
    let words = words.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
    let words = words.unwrap_or_else(|| "it crashed".to_owned());
    PanicException::new_err(format!("{words}; this is a fault of the program, please report it"))
}

/// Takes a lock, and lets other Python threads run while waiting for it.
pub fn lock<'a, T>(py: Python<'_>, mutex: &'a Mutex<T>) -> PyResult<MutexGuard<'a, T>> {
    loop {
        match mutex.try_lock() {
            Ok(guard) => return Ok(guard),
            Err(TryLockError::Poisoned(poisoned)) => return Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                py.detach(|| std::thread::sleep(Duration::from_millis(1)));
                py.check_signals()?;
            }
        }
    }
}
