//! The original of an import, as `urdd.json` names it.

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use urdd_directory::writer::sha256;
use urdd_format::registry::PROGRAM_VERSION;

use super::place::TextFile;
use urdd_source::Format;

/// The value of `x_urdd_imported`: the format, each file with its size and hash, and the importer.
pub fn origin(format: Format, files: &[TextFile]) -> Value {
    let entry = |file: &TextFile| {
        let name = file.shown.rsplit(['/', '\\']).next().unwrap_or_default();
        json!({
            "name": name,
            "size": file.bytes.len(),
            "sha256": sha256(&Sha256::digest(&file.bytes)).as_str(),
        })
    };
    json!({
        "format": format.name(),
        "files": files.iter().map(entry).collect::<Vec<_>>(),
        "importer": format!("urdd {PROGRAM_VERSION}"),
    })
}
