//! Receives an editor's messages, and keeps the open documents: the first messages, and then the loop, of messages of the editor and
//! what threads have computed.

mod documents;
pub mod state;

use std::collections::{HashMap, HashSet};
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, Sender, select, unbounded};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, RequestId, Response};
use serde_json::{Value, json};

use crate::options::Options;
use crate::server::state::{Client, Ended, Event, Pool, Process, Server, initialize_result};
use crate::uri;

/// How often the server looks whether the editor still runs.
const LOOK_FOR_PARENT: Duration = Duration::from_secs(2);
/// The request for what the user has set.
const CONFIGURATION: &str = "urdd configuration";

/// Serves one editor on a connection, until it ends or asks to.
pub fn run(connection: Connection) -> Ended {
    let (events, computed) = unbounded();
    match initialize(connection.sender, &connection.receiver, events) {
        Ok(mut server) => server.serve(&connection.receiver, &computed),
        Err(ended) => ended,
    }
}

impl Server {
    fn serve(&mut self, messages: &Receiver<Message>, computed: &Receiver<Event>) -> Ended {
        let mut looked = Instant::now();
        loop {
            let until_due = self.until_due().unwrap_or(LOOK_FOR_PARENT);
            select! {
                recv(messages) -> message => match message {
                    Ok(message) => if let Some(ended) = self.message(message) {
                        return ended;
                    },
                    Err(_) => return Ended::Closed,
                },
                recv(computed) -> event => if let Ok(event) = event {
                    self.event(event);
                },
                default(until_due.min(LOOK_FOR_PARENT)) => {}
            }
            self.start_due();
            if looked.elapsed() >= LOOK_FOR_PARENT {
                looked = Instant::now();
                if self.parent.is_some_and(|parent| !parent.is_running()) {
                    return Ended::ParentGone;
                }
            }
        }
    }

    fn message(&mut self, message: Message) -> Option<Ended> {
        match message {
            Message::Request(request) => self.request(request),
            Message::Notification(notification) if notification.method == "exit" => {
                return Some(if self.is_shut_down { Ended::Orderly } else { Ended::Exit });
            }
            Message::Notification(notification) => self.notification(notification),
            Message::Response(response) => self.response(response),
        }
        None
    }

    fn notification(&mut self, notification: Notification) {
        let Notification { method, params } = notification;
        match method.as_str() {
            "textDocument/didOpen" => self.read(&method, params, Server::open),
            "textDocument/didChange" => self.read(&method, params, Server::change),
            "textDocument/didSave" => self.read(&method, params, Server::save),
            "textDocument/didClose" => self.read(&method, params, Server::close),
            "workspace/didChangeConfiguration" => self.configured(&params),
            "initialized" => self.ask_configuration(),
            "$/cancelRequest" => {
                if let Ok(id) = serde_json::from_value(params["id"].clone()) {
                    self.cancel(id);
                }
            }
            // Others are not for this server.
            _ => {}
        }
    }

    /// Calls `handle` with a message's content. Says so if it cannot be read.
    fn read<P: serde::de::DeserializeOwned>(
        &mut self,
        method: &str,
        params: Value,
        handle: fn(&mut Self, P),
    ) {
        match serde_json::from_value(params) {
            Ok(params) => handle(self, params),
            Err(error) => self.log(&format!("{method}: {error}")),
        }
    }

    fn configured(&mut self, params: &Value) {
        let settings = &params["settings"];
        match settings.get("urdd") {
            Some(_) => self.configure(settings),
            // The editor says only that something changed.
            None => self.ask_configuration(),
        }
    }

    fn ask_configuration(&mut self) {
        if self.client.configuration {
            let params = json!({ "items": [{ "section": "urdd" }] });
            let id = RequestId::from(CONFIGURATION.to_owned());
            self.send(Request::new(id, "workspace/configuration".to_owned(), params));
        }
    }

    fn response(&mut self, response: Response) {
        if response.id != RequestId::from(CONFIGURATION.to_owned()) {
            return;
        }
        if let Ok(Value::Array(sections)) = response.response_result
            && let Some(section) = sections.first().filter(|section| section.is_object())
        {
            self.configure(section);
        }
    }

    fn event(&mut self, event: Event) {
        match event {
            // An editor that has asked for the end expects no more findings.
            Event::Analysed(..) if self.is_shut_down => {}
            Event::Analysed(snapshot, depth, analysis) => self.analysed(&snapshot, depth, analysis),
            // A request that was cancelled has its answer already.
            Event::Answered(id, answer) => {
                if self.pending.remove(&id) {
                    self.send(Response { id, response_result: answer });
                }
            }
        }
    }
}

/// Answers the editor's first message.
///
/// # Errors
/// If the editor ends before.
fn initialize(
    sender: Sender<Message>,
    messages: &Receiver<Message>,
    events: Sender<Event>,
) -> Result<Server, Ended> {
    loop {
        let request = match messages.recv() {
            Ok(Message::Request(request)) => request,
            Ok(Message::Notification(notification)) if notification.method == "exit" => {
                return Err(Ended::Exit);
            }
            Ok(_) => continue,
            Err(_) => return Err(Ended::Closed),
        };
        let refuse = |code: ErrorCode, message: String| {
            let response = Response::new_err(request.id.clone(), code as i32, message);
            let _ = sender.send(response.into());
        };
        if request.method != "initialize" {
            let message = "the first request has to be `initialize`".to_owned();
            refuse(ErrorCode::ServerNotInitialized, message);
            continue;
        }
        if !request.params["capabilities"].is_object() {
            let message = "the parameters of `initialize` have no object `capabilities`".to_owned();
            refuse(ErrorCode::InvalidParams, message);
            continue;
        }
        let server = begun(&request.params, sender, events);
        server.send(Response::new_ok(request.id, initialize_result(&server.client)));
        return Ok(server);
    }
}

/// Only what is used is read: what else an editor says may have any form.
fn begun(params: &Value, sender: Sender<Message>, events: Sender<Event>) -> Server {
    let folders = params["workspaceFolders"].as_array();
    let mut roots =
        folders.into_iter().flatten().filter_map(|folder| uri::path(folder["uri"].as_str()?));
    // Older editors name one folder.
    let root = roots.next().or_else(|| uri::path(params["rootUri"].as_str()?));
    let mut options = Options::default();
    if let Some(value) = params.get("initializationOptions") {
        options.update(value, root.as_deref());
    }
    let parent = params["processId"].as_u64().and_then(|id| u32::try_from(id).ok());
    Server {
        sender,
        client: Client::new(&params["capabilities"]),
        options,
        root,
        parent: parent.and_then(Process::find),
        documents: HashMap::new(),
        pending: HashSet::new(),
        events,
        quick: Pool::new("texts", 1),
        slow: Pool::new("files", 1),
        answers: Pool::new("answers", 2),
        is_shut_down: false,
    }
}
