//! What a thread keeps from one call to the next, so that calls on one configuration do not allocate.

use std::cell::RefCell;
use std::thread::LocalKey;

use nalgebra::Isometry3;
use urdd_robot::Workspace;

thread_local! {
    static POSES: RefCell<Vec<Isometry3<f64>>> = const { RefCell::new(Vec::new()) };
    static WORKSPACE: RefCell<Workspace> = RefCell::default();
}

/// Runs with this thread's poses.
pub(crate) fn with_poses<T>(act: impl FnOnce(&mut Vec<Isometry3<f64>>) -> T) -> T {
    with(&POSES, act)
}

/// Runs with this thread's workspace for distances.
pub(crate) fn with_workspace<T>(act: impl FnOnce(&mut Workspace) -> T) -> T {
    with(&WORKSPACE, act)
}

/// A thread that is ending keeps nothing any more: what it asks then starts from nothing.
fn with<K: Default, T>(kept: &'static LocalKey<RefCell<K>>, act: impl FnOnce(&mut K) -> T) -> T {
    let mut memory = kept.try_with(RefCell::take).unwrap_or_default();
    let found = act(&mut memory);
    let _ = kept.try_with(|kept| kept.replace(memory));
    found
}
