//! What the server can do, and what the editor can.

use lsp_types::{
    ClientCapabilities, CodeActionKind, CodeActionOptions, CompletionOptions,
    HoverProviderCapability, InitializeResult, OneOf, SaveOptions, ServerCapabilities, ServerInfo,
    TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    TextDocumentSyncSaveOptions,
};

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
    /// What an editor says of itself.
    pub fn new(capabilities: &ClientCapabilities) -> Self {
        let general = capabilities.general.as_ref();
        let offered = general.and_then(|general| general.position_encodings.as_deref());
        let text = capabilities.text_document.as_ref();
        let symbols = text.and_then(|text| text.document_symbol.as_ref());
        let published = text.and_then(|text| text.publish_diagnostics.as_ref());
        let actions = text.and_then(|text| text.code_action.as_ref());
        let workspace = capabilities.workspace.as_ref();
        let edits = workspace.and_then(|workspace| workspace.workspace_edit.as_ref());
        Client {
            encoding: Encoding::choose(offered),
            nested_symbols: symbols
                .and_then(|symbols| symbols.hierarchical_document_symbol_support)
                .unwrap_or_default(),
            related_places: published
                .and_then(|published| published.related_information)
                .unwrap_or_default(),
            versioned_edits: edits.and_then(|edits| edits.document_changes).unwrap_or_default(),
            code_actions: actions
                .is_some_and(|actions| actions.code_action_literal_support.is_some()),
            configuration: workspace
                .and_then(|workspace| workspace.configuration)
                .unwrap_or_default(),
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
