//! What the server knows.

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

use crossbeam_channel::Sender;
use lsp_server::{Message, Notification, RequestId, ResponseError};
use serde_json::{Value, json};

use super::open_document::Document;
use crate::analysis::{Analysis, Depth};
use crate::capabilities::Client;
use crate::document::Snapshot;
use crate::options::Options;
use crate::parent::Process;
use crate::pool::Pool;

/// What a thread has computed.
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
