//! The progress of a run.

use std::path::Path;

use urdd_format::registry::ModuleKind;

/// Receives the progress of a run.
pub trait Progress: Sync {
    /// A module is started; `done` of `total` modules are finished.
    fn module(&self, kind: ModuleKind, done: usize, total: usize);

    /// Progress within a slow module: `done` of `total` steps are finished.
    fn part(&self, _kind: ModuleKind, _done: usize, _total: usize) {}

    /// A module's work on the mesh of a link is finished. Links with the same mesh are reported once, by the first.
    fn link(&self, _kind: ModuleKind, _name: &str) {}

    /// A file of the source is about to be read: the URDF, a mesh, a texture. Also called for the places where a missing
    /// mesh was searched, since the robot changes when the file appears. Files that xacro includes are not reported.
    fn reads(&self, _file: &Path) {}
}

impl Progress for () {
    fn module(&self, _: ModuleKind, _: usize, _: usize) {}
}
