//! What the server knows: the editor's process, the open documents, and what threads have computed.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use crossbeam_channel::Sender;
use lsp_server::{Message, Notification, RequestId, ResponseError};
use serde_json::{Value, json};

use crate::analysis::{Analysis, Depth};
use crate::capabilities::Client;
use crate::diagnostics::Found;
use crate::document::Snapshot;
use crate::kept::kept;
use crate::options::Options;
use crate::pool::Pool;
use urdd_directory::cancellation::Cancellation;

/// How serving ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// The editor asked for it, as the protocol says.
    Orderly,
    /// The editor asked for it without announcing it.
    Exit,
    /// The editor closed the connection.
    Closed,
    /// The editor's process is gone.
    ParentGone,
}

impl Ended {
    /// Whether it ended as the protocol says: exit status 0, else 1.
    pub fn is_orderly(self) -> bool {
        self == Ended::Orderly
    }
}

/// The process of the editor, by its number. An editor that crashes leaves a server whose input may stay open.
#[derive(Debug, Clone, Copy)]
pub struct Process(u32);

impl Process {
    /// The process of a number; `None` if there is none that can be seen, as from within a container: then nobody can
    /// tell when it ends.
    pub fn find(id: u32) -> Option<Self> {
        let process = Process(id);
        process.is_running().then_some(process)
    }

    /// Whether it runs. A process of another user counts as running.
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    pub fn is_running(self) -> bool {
        let id = i32::try_from(self.0).ok().and_then(rustix::process::Pid::from_raw);
        let sent = id.map(rustix::process::test_kill_process);
        sent.is_some_and(|sent| sent != Err(rustix::io::Errno::SRCH))
    }

    /// Elsewhere, none can be seen: the end of the input is the only sign.
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    pub fn is_running(self) -> bool {
        false
    }
}

pub struct Document {
    pub snapshot: Arc<Snapshot>,
    /// When its findings are to be computed.
    pub due: Option<Instant>,
    /// The findings of the current text, once computed.
    pub of_text: Option<Analysis>,
    /// The last findings about files, with the version that they are about.
    pub of_files: Option<(Arc<Snapshot>, Analysis)>,
    /// Ends what is being computed.
    pub cancellation: Cancellation,
}

impl Document {
    /// Takes in the next version, whose findings are computed at `due`.
    pub fn replace(&mut self, next: Snapshot, due: Instant) {
        self.snapshot = Arc::new(next);
        self.due = Some(due);
        self.of_text = None;
        self.cancellation.cancel();
        self.cancellation = Cancellation::default();
    }

    /// The newest analysis of the current version: that of its files, else that of its text.
    pub fn analysis(&self) -> Option<&Analysis> {
        let of_files = self.of_files.as_ref();
        let of_files = of_files.filter(|(snapshot, _)| Arc::ptr_eq(snapshot, &self.snapshot));
        of_files.map(|(_, analysis)| analysis).or(self.of_text.as_ref())
    }

    /// The findings of the current version: those about files, if they are of this version; else those of the text, and
    /// what still stands of the last ones about files.
    pub fn findings(&self) -> Vec<Found> {
        if let Some((snapshot, analysis)) = &self.of_files
            && Arc::ptr_eq(snapshot, &self.snapshot)
        {
            return analysis.found.clone();
        }
        let Some(of_text) = &self.of_text else {
            return Vec::new();
        };
        let mut found = of_text.found.clone();
        if let Some((snapshot, analysis)) = &self.of_files {
            found.extend(kept((snapshot, analysis), &self.snapshot, &of_text.postponed));
        }
        found
    }
}

pub enum Event {
    /// The findings of a version of a document.
    Analysed(Arc<Snapshot>, Depth, Analysis),
    /// The answer to a request.
    Answered(RequestId, Result<Value, ResponseError>),
}

pub struct Server {
    pub sender: Sender<Message>,
    pub client: Client,
    pub options: Options,
    /// The first folder that is open in the editor.
    pub root: Option<PathBuf>,
    pub parent: Option<Process>,
    pub documents: HashMap<String, Document>,
    /// The requests that are being answered.
    pub pending: HashSet<RequestId>,
    pub events: Sender<Event>,
    /// For findings of texts.
    pub quick: Pool,
    /// For findings about files.
    pub slow: Pool,
    pub answers: Pool,
    pub is_shut_down: bool,
}

impl Server {
    pub fn send(&self, message: impl Into<Message>) {
        // If the editor is gone, the next message says so.
        let _ = self.sender.send(message.into());
    }

    /// Writes into the editor's log.
    pub fn log(&self, text: &str) {
        let params = json!({ "type": 2, "message": format!("urdd: {text}") });
        self.send(Notification::new("window/logMessage".to_owned(), params));
    }
}
