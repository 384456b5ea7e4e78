//! A module that was built: its document and its files.

use std::sync::Arc;

use serde::Serialize;

use super::error::GenerateError;
use urdd_directory::document::Document;

/// A module that was built.
pub(super) struct Made {
    pub document: Document,
    /// The files that the document references.
    pub files: Vec<MadeFile>,
}

/// A file of a module.
pub(super) struct MadeFile {
    /// Path relative to the URDD's root.
    pub path: String,
    pub content: Content,
}

/// The content of a file.
pub(super) enum Content {
    Bytes(Vec<u8>),
    /// A mesh file, whose bytes a mesh reader shares.
    Shared(Arc<Vec<u8>>),
}

/// A module without additional files.
pub(super) fn document(module: &impl Serialize) -> Result<Made, GenerateError> {
    streamed(serde_json::to_value(module).map(Document::Whole))
}

/// A module without additional files, from its document.
pub(super) fn streamed(
    document: Result<Document, serde_json::Error>,
) -> Result<Made, GenerateError> {
    let document = document.map_err(|error| GenerateError::Internal {
        file: String::new(),
        reason: error.to_string(),
    })?;
    let files = Vec::new();
    Ok(Made { document, files })
}
