//! Threads that work through jobs.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

use crossbeam_channel::{Sender, unbounded};

type Job = Box<dyn FnOnce() + Send>;

/// Threads that work through jobs in order. They end when the pool is dropped and the jobs are done.
pub struct Pool(Sender<Job>);

impl Pool {
    pub fn new(name: &str, threads: usize) -> Self {
        let (sender, receiver) = unbounded::<Job>();
        for _ in 0..threads {
            let receiver = receiver.clone();
            let builder = thread::Builder::new().name(format!("urdd {name}"));
            // Without a thread, its jobs are done by the others, or not at all: the editor still has the rest.
            let _ = builder.stack_size(STACK_BYTES).spawn(move || {
                for job in receiver {
                    // A job says itself that it panicked.
                    let _ = catch_unwind(AssertUnwindSafe(job));
                }
            });
        }
        Pool(sender)
    }

    pub fn add(&self, job: impl FnOnce() + Send + 'static) {
        let _ = self.0.send(Box::new(job));
    }
}

/// As for the main thread: rules read XML and schemas by recursion.
const STACK_BYTES: usize = 8 << 20;
