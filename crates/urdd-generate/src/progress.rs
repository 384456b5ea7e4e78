//! The progress of a run.

use urdd_format::registry::ModuleKind;

/// Receives the progress of a run.
pub trait Progress: Sync {
    /// A module is started; `done` of `total` modules are finished.
    fn module(&self, kind: ModuleKind, done: usize, total: usize);

    /// Progress within a slow module: `done` of `total` steps are finished.
    fn part(&self, _kind: ModuleKind, _done: usize, _total: usize) {}

    /// A module's work on the mesh of a link is finished. Links with the same mesh are reported once, by the first.
    fn link(&self, _kind: ModuleKind, _name: &str) {}
}

impl Progress for () {
    fn module(&self, _: ModuleKind, _: usize, _: usize) {}
}
