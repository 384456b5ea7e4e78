//! What a run has on the disk before it is done: folders in preparation, temporary ones, and locks. A program that has to
//! end at once removes them, between two writes: see [`abandon`].

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, RwLock, RwLockReadGuard, TryLockError};
use std::time::{Duration, Instant};

/// Held by all who write, for as long as a file needs to be made, or files to be moved into place.
static WRITING: RwLock<()> = RwLock::new(());
static PLACES: Mutex<Vec<(PathBuf, What)>> = Mutex::new(Vec::new());

/// Pause between two attempts to stop writing.
const PAUSE: Duration = Duration::from_millis(2);

/// What is in a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum What {
    /// A file or a folder of the run's own.
    Own,
    /// A new folder of a person's, which is removed if it is empty.
    Folder,
}

/// A place that is removed if the program has to end before this is dropped.
#[derive(Debug)]
pub(crate) struct Unfinished(PathBuf);

impl Unfinished {
    pub(crate) fn new(place: &Path, what: What) -> Self {
        places().push((place.to_owned(), what));
        Unfinished(place.to_owned())
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        let mut places = places();
        if let Some(at) = places.iter().rposition(|(place, _)| *place == self.0) {
            places.remove(at);
        }
    }
}

fn places() -> MutexGuard<'static, Vec<(PathBuf, What)>> {
    PLACES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Begins to write: [`abandon`] waits until the result is dropped. After it, this does not return.
pub fn writing() -> RwLockReadGuard<'static, ()> {
    WRITING.read().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is unfinished. Nothing is written afterwards: the program has to end. `false` if somebody still writes
/// after `patience`: then everything stays, as after a kill.
pub fn abandon(patience: Duration) -> bool {
    let begun = Instant::now();
    let ended = loop {
        match WRITING.try_write() {
            Ok(ended) => break ended,
            Err(TryLockError::Poisoned(ended)) => break ended.into_inner(),
            Err(TryLockError::WouldBlock) if begun.elapsed() >= patience => return false,
            Err(TryLockError::WouldBlock) => std::thread::sleep(PAUSE),
        }
    };
    std::mem::forget(ended);
    for (place, what) in places().iter().rev() {
        match what {
            What::Folder => drop(fs::remove_dir(place)),
            What::Own => drop(fs::remove_dir_all(place).or_else(|_| fs::remove_file(place))),
        }
    }
    true
}
