//! Computes findings in other threads, and shows them.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

use lsp_server::Notification;
use lsp_types::{Diagnostic, DiagnosticSeverity, PublishDiagnosticsParams, Uri};

use super::state::{Document, Event, Server};
use crate::analysis::{Analysis, Depth};
use crate::diagnostics::{Found, at_the_top};
use crate::document::Snapshot;
use crate::kind::Kind;

/// Maximum number of findings that are shown of a document.
const MOST_SHOWN: usize = 1000;

impl Server {
    /// How long until the findings of a document are to be computed.
    pub(super) fn until_due(&self) -> Option<Duration> {
        let due = self.documents.values().filter_map(|document| document.due);
        due.min().map(|due| due.saturating_duration_since(Instant::now()))
    }

    /// Computes the findings that are due.
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
            if depth == Depth::Text && matches!(snapshot.kind, Kind::Urdf) {
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

    /// Shows the findings of a document.
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
