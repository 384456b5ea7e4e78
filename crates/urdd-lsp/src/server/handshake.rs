//! The first messages.

use std::path::PathBuf;

use crossbeam_channel::{Receiver, Sender};
use lsp_server::{ErrorCode, Message, Response};
use serde_json::Value;

use super::state::{Ended, Process};
use crate::capabilities::{Client, initialize_result};
use crate::options::Options;
use crate::uri;

/// What the editor said of itself.
pub struct Begun {
    pub client: Client,
    pub options: Options,
    pub root: Option<PathBuf>,
    pub parent: Option<Process>,
}

/// Answers the editor's first message.
///
/// # Errors
/// If the editor ends before.
pub fn initialize(sender: &Sender<Message>, messages: &Receiver<Message>) -> Result<Begun, Ended> {
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
        let begun = begun(&request.params);
        let response = Response::new_ok(request.id, initialize_result(&begun.client));
        let _ = sender.send(response.into());
        return Ok(begun);
    }
}

/// Only what is used is read: what else an editor says may have any form.
fn begun(params: &Value) -> Begun {
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
    Begun {
        client: Client::new(&params["capabilities"]),
        options,
        root,
        parent: parent.and_then(Process::find),
    }
}
