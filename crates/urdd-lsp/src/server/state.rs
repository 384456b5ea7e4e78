//! What the server knows: what it and the editor can do, the editor's process, the open documents, and what threads have computed.

use std::collections::{HashMap, HashSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::Instant;

use crossbeam_channel::{Sender, unbounded};
use lsp_server::{Message, Notification, RequestId, ResponseError};
use lsp_types::{
    CodeActionKind, CodeActionOptions, CompletionOptions, HoverProviderCapability,
    InitializeResult, OneOf, SaveOptions, ServerCapabilities, ServerInfo,
    TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    TextDocumentSyncSaveOptions,
};
use serde_json::{Value, json};
use urdd_directory::cancellation::Cancellation;
use urdd_format::registry::PROGRAM_VERSION;

use crate::analysis::{Analysis, Depth, kept};
use crate::diagnostics::{FIX_ALL, Found};
use crate::document::Snapshot;
use crate::options::Options;
use crate::text::Encoding;

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

    pub fn log(&self, text: &str) {
        let params = json!({ "type": 2, "message": format!("urdd: {text}") });
        self.send(Notification::new("window/logMessage".to_owned(), params));
    }
}

/// What the editor can do.
#[derive(Debug, Clone, Copy, Default)]
pub struct Client {
    /// The unit of its columns.
    pub encoding: Encoding,
    /// Whether it shows outlines as trees.
    pub nested_symbols: bool,
    /// Whether it shows places related to a diagnostic.
    pub related_places: bool,
    /// Whether it takes edits of a version of a document.
    pub versioned_edits: bool,
    /// Whether it takes code actions, not only commands.
    pub code_actions: bool,
    /// Whether it answers what the user has set.
    pub configuration: bool,
}

impl Client {
    /// What an editor says of itself in the `capabilities` of its first message.
    pub fn new(capabilities: &Value) -> Self {
        let at = |pointer: &str| capabilities.pointer(pointer);
        let has = |pointer: &str| at(pointer).and_then(Value::as_bool).unwrap_or_default();
        Client {
            encoding: Encoding::choose(at("/general/positionEncodings")),
            nested_symbols: has("/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport"),
            related_places: has("/textDocument/publishDiagnostics/relatedInformation"),
            versioned_edits: has("/workspace/workspaceEdit/documentChanges"),
            code_actions: at("/textDocument/codeAction/codeActionLiteralSupport")
                .is_some_and(Value::is_object),
            configuration: has("/workspace/configuration"),
        }
    }
}

pub fn initialize_result(client: &Client) -> InitializeResult {
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::INCREMENTAL),
        save: Some(TextDocumentSyncSaveOptions::SaveOptions(SaveOptions {
            include_text: Some(false),
        })),
        ..TextDocumentSyncOptions::default()
    };
    let completion = CompletionOptions {
        trigger_characters: Some(["<", "/", "\"", "'", " "].map(str::to_owned).to_vec()),
        ..CompletionOptions::default()
    };
    let actions = CodeActionOptions {
        code_action_kinds: Some(vec![CodeActionKind::QUICKFIX, FIX_ALL]),
        ..CodeActionOptions::default()
    };
    InitializeResult {
        capabilities: ServerCapabilities {
            position_encoding: Some(client.encoding.kind()),
            text_document_sync: Some(TextDocumentSyncCapability::Options(sync)),
            hover_provider: Some(HoverProviderCapability::Simple(true)),
            completion_provider: Some(completion),
            definition_provider: Some(OneOf::Left(true)),
            document_symbol_provider: Some(OneOf::Left(true)),
            code_action_provider: client.code_actions.then(|| actions.into()),
            ..ServerCapabilities::default()
        },
        server_info: Some(ServerInfo {
            name: "urdd".to_owned(),
            version: Some(PROGRAM_VERSION.to_owned()),
        }),
    }
}

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
