//! What the server can do, and what the editor can.

use lsp_types::{
    CodeActionKind, CodeActionOptions, CompletionOptions, HoverProviderCapability,
    InitializeResult, OneOf, SaveOptions, ServerCapabilities, ServerInfo,
    TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    TextDocumentSyncSaveOptions,
};
use serde_json::Value;

use crate::code_actions::FIX_ALL;
use crate::text::Encoding;
use urdd_format::registry::PROGRAM_VERSION;

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

/// The answer to an editor's first message.
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
