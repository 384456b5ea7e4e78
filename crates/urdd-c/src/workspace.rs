//! What a thread keeps from one call to the next, so that calls on one configuration do not allocate.

use std::cell::RefCell;

use nalgebra::Isometry3;

thread_local! {
    static POSES: RefCell<Vec<Isometry3<f64>>> = const { RefCell::new(Vec::new()) };
}

/// Runs with this thread's poses. A thread that is ending keeps none any more, and starts from nothing.
pub(crate) fn with_poses<T>(act: impl FnOnce(&mut Vec<Isometry3<f64>>) -> T) -> T {
    let mut poses = POSES.try_with(RefCell::take).unwrap_or_default();
    let found = act(&mut poses);
    let _ = POSES.try_with(|kept| kept.replace(poses));
    found
}
