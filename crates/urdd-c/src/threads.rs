//! Where batches run: on one pool of threads, or on the calling thread where that pool cannot answer.

use std::error::Error;
use std::mem::forget;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::ThreadPoolBuilder;

/// True in a child of `fork`, which has no thread of the pool, and where no thread can be started.
static ALONE: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
unsafe extern "C" {
    fn pthread_atfork(
        before: Option<extern "C" fn()>,
        parent: Option<extern "C" fn()>,
        child: Option<extern "C" fn()>,
    ) -> std::ffi::c_int;
}

extern "C" fn alone() {
    ALONE.store(true, Ordering::Relaxed);
}

/// Starts the pool at the first call. Where it cannot answer, makes this thread a pool of one.
pub(crate) fn ready() {
    static START: Once = Once::new();
    START.call_once(|| {
        // SAFETY: the function does nothing that a child may not do.
        #[cfg(unix)]
        unsafe {
            pthread_atfork(None, None, Some(alone));
        }
        // A pool that the program has already started is an error without a source, and is used.
        let started = ThreadPoolBuilder::new().build_global();
        if started.is_err_and(|error| error.source().is_some()) {
            alone();
        }
    });
    if ALONE.load(Ordering::Relaxed) && rayon::current_thread_index().is_none() {
        let one = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
        // It lives as long as its thread.
        forget(one);
    }
}
