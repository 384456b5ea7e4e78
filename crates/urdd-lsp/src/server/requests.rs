//! Answers requests, in other threads.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use lsp_server::{ErrorCode, Request, RequestId, Response, ResponseError};
use lsp_types::{
    CodeActionParams, CompletionParams, DocumentSymbolParams, GotoDefinitionParams, HoverParams,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::state::{Document, Event, Server};
use crate::analysis::{Analysis, Depth};
use crate::code_actions::code_actions;
use crate::completion::completion;
use crate::definition::definition;
use crate::document::Snapshot;
use crate::hover::hover;
use crate::symbols::symbols;
use urdd_directory::cancellation::Cancellation;

impl Server {
    pub(super) fn request(&mut self, request: Request) {
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
    pub(super) fn cancel(&mut self, id: RequestId) {
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
