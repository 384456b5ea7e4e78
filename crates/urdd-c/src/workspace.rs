//! What a thread keeps from one call to the next, so that calls on one configuration do not allocate.

use std::cell::RefCell;

use nalgebra::Isometry3;
use urdd_robot::Workspace;

thread_local! {
    static POSES: RefCell<Vec<Isometry3<f64>>> = const { RefCell::new(Vec::new()) };
    static WORKSPACE: RefCell<Workspace> = RefCell::default();
}

/// Runs with this thread's poses.
pub(crate) fn with_poses<T>(act: impl FnOnce(&mut Vec<Isometry3<f64>>) -> T) -> T {
    POSES.with_borrow_mut(act)
}

/// Runs with this thread's workspace for distances.
pub(crate) fn with_workspace<T>(act: impl FnOnce(&mut Workspace) -> T) -> T {
    WORKSPACE.with_borrow_mut(act)
}
