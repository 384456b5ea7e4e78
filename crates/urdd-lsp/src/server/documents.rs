//! Opens, changes, saves and closes documents; computes their findings in other threads, and shows them.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

use lsp_server::Notification;
use lsp_types::{
    Diagnostic, DiagnosticSeverity, DidChangeTextDocumentParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, DidSaveTextDocumentParams, PublishDiagnosticsParams, Uri,
};
use serde_json::Value;

use super::state::{Document, Event, Server};
use crate::analysis::{Analysis, Depth};
use crate::diagnostics::{Found, at_the_top};
use crate::document::Snapshot;
use crate::kind::FileKind;
use crate::text::Text;
use urdd_directory::cancellation::Cancellation;

/// Maximum number of findings that are shown of a document.
const MOST_SHOWN: usize = 1000;

impl Server {
    pub(super) fn open(&mut self, params: DidOpenTextDocumentParams) {
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

    pub(super) fn change(&mut self, params: DidChangeTextDocumentParams) {
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

    pub(super) fn save(&mut self, params: DidSaveTextDocumentParams) {
        let uri = params.text_document.uri.as_str().to_owned();
        if let Some(document) = self.documents.get_mut(&uri) {
            let is_due = document.due.take().is_some();
            if is_due {
                self.start(&uri, Depth::Text);
            }
            self.start(&uri, Depth::Files);
        }
    }

    pub(super) fn close(&mut self, params: DidCloseTextDocumentParams) {
        let uri = params.text_document.uri;
        if let Some(document) = self.documents.remove(uri.as_str()) {
            document.cancellation.cancel();
            self.publish(uri, None, Vec::new());
        }
    }

    /// Takes over what the user sets. Everything is examined anew.
    pub(super) fn configure(&mut self, value: &Value) {
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
    pub(super) fn until_due(&self) -> Option<Duration> {
        let due = self.documents.values().filter_map(|document| document.due);
        due.min().map(|due| due.saturating_duration_since(Instant::now()))
    }

    pub(super) fn start_due(&mut self) {
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
    pub(super) fn start(&mut self, uri: &str, depth: Depth) {
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
    pub(super) fn analysed(&mut self, snapshot: &Arc<Snapshot>, depth: Depth, analysis: Analysis) {
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

    pub(super) fn publish(&self, uri: Uri, version: Option<i32>, found: Vec<Found>) {
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
