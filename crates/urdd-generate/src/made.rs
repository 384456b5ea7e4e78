//! What a stage returns.

use std::collections::HashMap;
use std::sync::Arc;

use serde::Serialize;

use super::error::{GenerateError, Result};
use urdd_directory::document::Document;
use urdd_source::note::Note;

/// The SHA-256 of each file that was written or kept, by its path.
pub(super) type Digests = HashMap<String, String>;

pub(super) struct Made<T = ()> {
    /// The module; `None` if it is of no use for this robot.
    pub document: Option<Document>,
    pub files: Vec<MadeFile>,
    pub notes: Vec<Note>,
    /// What later stages use.
    pub product: T,
}

/// What a stage returns whose module later stages use.
pub(crate) type Shared<T> = Result<Made<Arc<T>>>;

pub(super) struct MadeFile {
    /// Path relative to the URDD's root.
    pub path: String,
    /// Its content, which a mesh reader or another link may share.
    pub bytes: Arc<Vec<u8>>,
}

/// A module without additional files, from its document.
pub(super) fn streamed<T>(
    document: Result<Document, serde_json::Error>,
    product: T,
) -> Result<Made<T>> {
    let document = document.map_err(|error| GenerateError::internal("", error))?;
    Ok(Made { document: Some(document), files: Vec::new(), notes: Vec::new(), product })
}

/// A module without additional files or product.
pub(super) fn made(module: &impl Serialize) -> Result<Made> {
    made_with(module, Vec::new(), ())
}

/// A module with its files and product.
pub(super) fn made_with<T>(
    module: &impl Serialize,
    files: Vec<MadeFile>,
    product: T,
) -> Result<Made<T>> {
    let made = streamed(serde_json::to_value(module).map(Document::Whole), product)?;
    Ok(Made { files, ..made })
}
