//! A server in this process, to ask.

use std::ops::Deref;
use std::path::Path;
use std::sync::Arc;
use std::thread::JoinHandle;

use testkit::requests::Requests;
use urdd_directory::cancellation::Cancellation;
use urdd_view::{Collection, Server};

/// A server at work, until it is dropped.
pub struct Running {
    requests: Requests,
    cancellation: Cancellation,
    thread: Option<JoinHandle<()>>,
}

impl Running {
    pub fn on(path: &Path) -> Self {
        let collection = Collection::default();
        collection.add(path).expect("a URDD");
        Self::with(collection)
    }

    pub fn with(collection: impl Into<Arc<Collection>>) -> Self {
        let server = Server::bind(collection, None).expect("a port");
        let requests = Requests::to(&server.address());
        let cancellation = Cancellation::default();
        let wish = cancellation.clone();
        let thread = Some(std::thread::spawn(move || server.run(&wish)));
        Self { requests, cancellation, thread }
    }
}

impl Deref for Running {
    type Target = Requests;

    fn deref(&self) -> &Requests {
        &self.requests
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.cancellation.cancel();
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
