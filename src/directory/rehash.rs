//! Bringing the sizes and hashes in `urdd.json` up to date with the files.

use std::fs;
use std::io::{self, Write};

use serde_json::{Value, json};
use thiserror::Error;

use super::canonical;
use super::digest;
use super::discover::ROOT_METADATA;
use super::json;
use super::limits::MAX_DOCUMENT_BYTES;
use super::root::{ReadError, Root};

/// Why the hashes could not be brought up to date.
#[derive(Debug, Error)]
pub enum RehashError {
    /// `urdd.json` cannot be read.
    #[error("{ROOT_METADATA}: {0}")]
    Metadata(ReadError),
    /// `urdd.json` is not JSON.
    #[error("{ROOT_METADATA} is not JSON: {0}; `urdd validate` says more")]
    NotJson(#[from] super::text_fault::UnreadableText),
    /// A listed file cannot be read.
    #[error("{path}: {error}; take it off the list in {ROOT_METADATA}, or bring it back")]
    File {
        /// The path as it is listed.
        path: String,
        /// What is wrong.
        error: ReadError,
    },
    /// `urdd.json` cannot be written.
    #[error("{ROOT_METADATA} cannot be written: {0}")]
    Write(#[from] io::Error),
}

/// Brings size and SHA-256 of every file that `urdd.json` lists up to date, and writes it where
/// something changed. Gives the paths whose entries changed.
///
/// Nothing else is touched, and nothing is judged: whoever calls this vouches for the files.
///
/// # Errors
/// Where `urdd.json` or a listed file cannot be read, or the new one not written; then nothing is
/// changed.
pub fn rehash(root: &Root) -> Result<Vec<String>, RehashError> {
    let bytes = root
        .read(ROOT_METADATA, MAX_DOCUMENT_BYTES)
        .map_err(RehashError::Metadata)?;
    let mut metadata = json::read(&bytes)?.value;
    let mut changed = Vec::new();
    if let Some(entry) = metadata.pointer_mut("/source/Urdf") {
        update(root, entry, &mut changed)?;
    }
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    for module in modules.into_iter().flatten() {
        let files = module.get_mut("files").and_then(Value::as_array_mut);
        for entry in files.into_iter().flatten() {
            update(root, entry, &mut changed)?;
        }
    }
    if !changed.is_empty() {
        // Beside it and renamed: whoever reads at this moment sees the old one or the new one.
        let mut file = tempfile_beside(root)?;
        file.1
            .write_all(canonical::json_string(&metadata).as_bytes())?;
        file.1.sync_all()?;
        fs::rename(&file.0, root.path().join(ROOT_METADATA))?;
    }
    Ok(changed)
}

fn tempfile_beside(root: &Root) -> io::Result<(std::path::PathBuf, fs::File)> {
    let path = root
        .path()
        .join(format!(".{ROOT_METADATA}.{}", std::process::id()));
    let file = fs::OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(&path)?;
    Ok((path, file))
}

fn update(root: &Root, entry: &mut Value, changed: &mut Vec<String>) -> Result<(), RehashError> {
    let Some(path) = entry.get("path").and_then(Value::as_str).map(str::to_owned) else {
        return Ok(());
    };
    let (size, sha256) = digest::of(root, &path).map_err(|error| RehashError::File {
        path: path.clone(),
        error,
    })?;
    let (size, sha256) = (json!(size), json!(sha256));
    if entry["size"] != size || entry["sha256"] != sha256 {
        entry["size"] = size;
        entry["sha256"] = sha256;
        changed.push(path);
    }
    Ok(())
}
