//! The progress of a run.

use urdd_format::registry::ModuleKind;

/// Receives the progress of a run.
pub trait Progress: Sync {
    /// A module is started; `done` of `total` modules are finished.
    fn module(&self, kind: ModuleKind, done: usize, total: usize);

    /// Progress within a slow module: `done` of `total` steps are finished.
    fn part(&self, _kind: ModuleKind, _done: usize, _total: usize) {}
}

impl Progress for () {
    fn module(&self, _: ModuleKind, _: usize, _: usize) {}
}
