//! Opens, changes, saves and closes documents.

use std::sync::Arc;
use std::time::Instant;

use lsp_types::{
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams,
    DidSaveTextDocumentParams,
};
use serde_json::Value;

use super::state::{Document, Server};
use crate::analysis::Depth;
use crate::document::Snapshot;
use crate::kind::Kind;
use crate::text::Text;
use urdd_directory::cancellation::Cancellation;

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
        if document.is_some_and(|document| matches!(document.snapshot.kind, Kind::Urdf)) {
            self.start(uri, Depth::Files);
        }
    }
}
