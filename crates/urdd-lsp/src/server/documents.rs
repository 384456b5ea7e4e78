//! Opens, changes, saves and closes documents; computes their findings and answers requests in other threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

use lsp_server::{ErrorCode, Notification, Request, RequestId, Response, ResponseError};
use lsp_types::{
    CodeActionParams, CompletionParams, Diagnostic, DiagnosticSeverity,
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams,
    DidSaveTextDocumentParams, DocumentSymbolParams, GotoDefinitionParams, HoverParams,
    PublishDiagnosticsParams, Uri,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use urdd_directory::cancellation::Cancellation;

use crate::analysis::{Analysis, Depth};
use crate::completion::completion;
use crate::diagnostics::{Found, at_the_top, code_actions};
use crate::document::{FileKind, Snapshot};
use crate::hover::hover;
use crate::reference::definition;
use crate::server::state::{Document, Event, Server};
use crate::symbols::symbols;
use crate::text::Text;

/// Maximum number of findings that are shown of a document.
const MOST_SHOWN: usize = 1000;

impl Server {
    pub fn open(&mut self, params: DidOpenTextDocumentParams) {
        let item = params.text_document;
        let uri = item.uri.as_str().to_owned();
        let text = Text::new(item.text, self.client.encoding);
        let root = self.root.as_deref();
        let snapshot =
            Snapshot::new(item.uri, &item.language_id, item.version, text, root, &self.options);
        let document = Document {
            snapshot: Arc::new(snapshot),
            due: None,
            of_text: None,
            of_files: None,
            cancellation: Cancellation::default(),
        };
        if let Some(old) = self.documents.insert(uri.clone(), document) {
            old.cancellation.cancel();
        }
        self.start_all(&uri);
    }

    pub fn change(&mut self, params: DidChangeTextDocumentParams) {
        let uri = params.text_document.uri.as_str();
        let due = Instant::now() + self.options.debounce;
        let Some(document) = self.documents.get_mut(uri) else {
            return self.log(&format!("{uri} was changed without being opened"));
        };
        let mut text = document.snapshot.text.clone();
        for change in params.content_changes {
            text.apply(change);
        }
        let next = document.snapshot.next(params.text_document.version, text, &self.options);
        if !next.kind.is_xml() {
            document.of_files = None;
        }
        document.replace(next, due);
    }

    pub fn save(&mut self, params: DidSaveTextDocumentParams) {
        let uri = params.text_document.uri.as_str().to_owned();
        if let Some(document) = self.documents.get_mut(&uri) {
            let is_due = document.due.take().is_some();
            if is_due {
                self.start(&uri, Depth::Text);
            }
            self.start(&uri, Depth::Files);
        }
    }

    pub fn close(&mut self, params: DidCloseTextDocumentParams) {
        let uri = params.text_document.uri;
        if let Some(document) = self.documents.remove(uri.as_str()) {
            document.cancellation.cancel();
            self.publish(uri, None, Vec::new());
        }
    }

    /// Takes over what the user sets. Everything is examined anew.
    pub fn configure(&mut self, value: &Value) {
        let before = self.options.clone();
        self.options.update(value, self.root.as_deref());
        if self.options == before {
            return;
        }
        let uris: Vec<String> = self.documents.keys().cloned().collect();
        for uri in uris {
            if let Some(document) = self.documents.get_mut(&uri) {
                let old = &document.snapshot;
                let next = old.next(old.version, old.text.clone(), &self.options);
                document.replace(next, Instant::now());
                document.due = None;
                document.of_files = None;
            }
            self.start_all(&uri);
        }
    }

    /// Computes all findings that need no leave: xacro runs when a file is saved, and not before.
    fn start_all(&mut self, uri: &str) {
        self.start(uri, Depth::Text);
        let document = self.documents.get(uri);
        if document.is_some_and(|document| matches!(document.snapshot.kind, FileKind::Urdf)) {
            self.start(uri, Depth::Files);
        }
    }

    /// How long until the findings of a document are to be computed.
    pub fn until_due(&self) -> Option<Duration> {
        let due = self.documents.values().filter_map(|document| document.due);
        due.min().map(|due| due.saturating_duration_since(Instant::now()))
    }

    pub fn start_due(&mut self) {
        let now = Instant::now();
        let is_due =
            |(_, document): &(_, &mut Document)| document.due.is_some_and(|due| due <= now);
        let due = self.documents.iter_mut().filter(is_due).map(|(uri, document)| {
            document.due = None;
            uri.clone()
        });
        for uri in due.collect::<Vec<_>>() {
            self.start(&uri, Depth::Text);
        }
    }

    /// Computes findings of the current version.
    pub fn start(&mut self, uri: &str, depth: Depth) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        let snapshot = Arc::clone(&document.snapshot);
        // Documents of a URDD, and texts that are too large, have nothing else.
        if depth == Depth::Files && (!snapshot.kind.is_xml() || snapshot.is_too_large()) {
            return;
        }
        let cancellation = document.cancellation.clone();
        let events = self.events.clone();
        let job = move || {
            if cancellation.is_cancelled() {
                return;
            }
            let computed =
                catch_unwind(AssertUnwindSafe(|| Analysis::new(&snapshot, depth, &cancellation)));
            let crashed = || {
                let message =
                    "urdd crashed while it examined this file; this is a bug, please report it";
                let found = at_the_top(&snapshot, DiagnosticSeverity::WARNING, message);
                Some(Analysis::of(vec![found]))
            };
            let Some(analysis) = computed.unwrap_or_else(|_| crashed()) else {
                return;
            };
            let _ = events.send(Event::Analysed(Arc::clone(&snapshot), depth, analysis));
            // For hovers over later texts that describe no robot.
            if depth == Depth::Text && matches!(snapshot.kind, FileKind::Urdf) {
                let _ = catch_unwind(AssertUnwindSafe(|| snapshot.robot()));
            }
        };
        match depth {
            Depth::Text => self.quick.add(job),
            Depth::Files => self.slow.add(job),
        }
    }

    /// Takes over findings, and shows them if they are of the current version.
    pub fn analysed(&mut self, snapshot: &Arc<Snapshot>, depth: Depth, analysis: Analysis) {
        let Some(document) = self.documents.get_mut(snapshot.uri.as_str()) else {
            return;
        };
        if !Arc::ptr_eq(&document.snapshot, snapshot) {
            return;
        }
        match depth {
            Depth::Text => document.of_text = Some(analysis),
            Depth::Files => document.of_files = Some((Arc::clone(snapshot), analysis)),
        }
        let found = document.findings();
        self.publish(snapshot.uri.clone(), Some(snapshot.version), found);
    }

    pub fn publish(&self, uri: Uri, version: Option<i32>, found: Vec<Found>) {
        let all = found.len();
        let found = found.into_iter().map(|found| found.diagnostic);
        let mut diagnostics: Vec<Diagnostic> = found.take(MOST_SHOWN).collect();
        if let (true, Some(last)) = (all > MOST_SHOWN, diagnostics.last_mut()) {
            last.message += &format!("\n({} more findings are not shown)", all - MOST_SHOWN);
        }
        if !self.client.related_places {
            for diagnostic in &mut diagnostics {
                diagnostic.related_information = None;
            }
        }
        let params = PublishDiagnosticsParams { uri, diagnostics, version };
        let method = "textDocument/publishDiagnostics".to_owned();
        self.send(Notification::new(method, params));
    }
}

impl Server {
    pub fn request(&mut self, request: Request) {
        let Request { id, method, params } = request;
        if self.is_shut_down {
            let message = "the server was asked to shut down".to_owned();
            return self.refuse(id, ErrorCode::InvalidRequest, message);
        }
        let client = self.client;
        match method.as_str() {
            "shutdown" => {
                self.is_shut_down = true;
                self.send(Response::new_ok(id, Value::Null));
            }
            "textDocument/hover" => self.hover(id, params),
            "textDocument/definition" => {
                self.answer(id, params, |snapshot, params: GotoDefinitionParams| {
                    definition(snapshot, params.text_document_position_params.position)
                });
            }
            "textDocument/completion" => {
                self.answer(id, params, |snapshot, params: CompletionParams| {
                    completion(snapshot, params.text_document_position.position)
                });
            }
            "textDocument/documentSymbol" => {
                self.answer(id, params, move |snapshot, _: DocumentSymbolParams| {
                    symbols(snapshot, client.nested_symbols)
                });
            }
            "textDocument/codeAction" => self.code_actions(id, params),
            _ => {
                self.refuse(id, ErrorCode::MethodNotFound, format!("there is no method {method}"));
            }
        }
    }

    fn hover(&mut self, id: RequestId, params: Value) {
        let document = uri_of(&params).and_then(|uri| self.documents.get(uri));
        let known = document.and_then(Document::analysis);
        let known = known.map(|analysis| analysis.programs.clone());
        self.answer(id, params, move |snapshot, params: HoverParams| {
            let programs = || known.unwrap_or_else(|| now(snapshot).programs);
            hover(snapshot, params.text_document_position_params.position, programs)
        });
    }

    fn code_actions(&mut self, id: RequestId, params: Value) {
        let client = self.client;
        let uri = uri_of(&params).unwrap_or_default().to_owned();
        let document = self.documents.get(&uri);
        let known = document.filter(|one| one.of_text.is_some()).map(Document::findings);
        self.answer(id, params, move |snapshot, params: CodeActionParams| {
            // Before the findings of the newest text are there, as where an editor fixes on save.
            let found = known.unwrap_or_else(|| now(snapshot).found);
            code_actions(snapshot, &found, &params, client.versioned_edits)
        });
    }

    /// Answers a request about a document in another thread; with null if the document is not open.
    fn answer<P: DeserializeOwned + Send + 'static, R: Serialize>(
        &mut self,
        id: RequestId,
        params: Value,
        compute: impl FnOnce(&Snapshot, P) -> R + Send + 'static,
    ) {
        let document = uri_of(&params).and_then(|uri| self.documents.get(uri));
        let snapshot = document.map(|document| Arc::clone(&document.snapshot));
        let params: P = match serde_json::from_value(params) {
            Ok(params) => params,
            Err(error) => return self.refuse(id, ErrorCode::InvalidParams, error.to_string()),
        };
        let Some(snapshot) = snapshot else {
            return self.send(Response::new_ok(id, Value::Null));
        };
        self.pending.insert(id.clone());
        let events = self.events.clone();
        self.answers.add(move || {
            let computed = catch_unwind(AssertUnwindSafe(|| compute(&snapshot, params)));
            let answer = match computed.map(serde_json::to_value) {
                Ok(Ok(value)) => Ok(value),
                Ok(Err(error)) => Err(failure(error.to_string())),
                Err(_) => {
                    let message = "urdd crashed on this request; this is a bug, please report it";
                    Err(failure(message.to_owned()))
                }
            };
            let _ = events.send(Event::Answered(id, answer));
        });
    }

    /// Answers at once that a request was cancelled. What is computed for it is dropped.
    pub fn cancel(&mut self, id: RequestId) {
        if self.pending.remove(&id) {
            self.refuse(id, ErrorCode::RequestCanceled, "cancelled by the editor".to_owned());
        }
    }

    fn refuse(&self, id: RequestId, code: ErrorCode, message: String) {
        self.send(Response::new_err(id, code as i32, message));
    }
}

/// The analysis of a text whose own is not there yet.
fn now(snapshot: &Snapshot) -> Analysis {
    Analysis::new(snapshot, Depth::Text, &Cancellation::default()).unwrap_or_default()
}

fn failure(message: String) -> ResponseError {
    ResponseError { code: ErrorCode::InternalError as i32, message, data: None }
}

fn uri_of(params: &Value) -> Option<&str> {
    params["textDocument"]["uri"].as_str()
}
