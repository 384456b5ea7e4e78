//! Updates the sizes and hashes in `urdd.json` to match the files.

use std::fs;
use std::io;
use std::path::Path;

use serde_json::Value;
use thiserror::Error;

use super::canonical;
use super::digest;
use super::discover::ROOT_METADATA;
use super::file_entry;
use super::json;
use super::limits::MAX_DOCUMENT_BYTES;
use super::root::{ReadError, Root};
use super::staging::{Staging, StagingError};
use super::target_lock::TargetLock;
use super::writer::Writer;
use crate::cancellation::Cancellation;

/// Why the hashes could not be updated.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum RehashError {
    #[error("{ROOT_METADATA}: {0}")]
    Metadata(ReadError),
    #[error("{ROOT_METADATA} is not JSON: {0}; run `urdd validate` for details")]
    NotJson(#[from] super::text_fault::UnreadableText),
    #[error("{path}: {error}; remove it from the list in {ROOT_METADATA}, or restore it")]
    File { path: String, error: ReadError },
    #[error("zip archives are read only; unpack it, rehash the folder, and pack it again")]
    NotAFolder,
    #[error("{ROOT_METADATA} cannot be written: {0}")]
    Write(#[from] io::Error),
}

/// Updates size and SHA-256 of every file that `urdd.json` lists. Writes `urdd.json` only if something changed. Returns
/// the paths whose entries changed.
///
/// Changes no other file and validates nothing: the caller vouches for the files.
///
/// # Errors
/// If `urdd.json` or a listed file cannot be read, or the new `urdd.json` cannot be written. Nothing is changed then.
pub fn rehash(root: &Root) -> Result<Vec<String>, RehashError> {
    let folder = root.folder().ok_or(RehashError::NotAFolder)?;
    let _lock = lock(folder);
    let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).map_err(RehashError::Metadata)?;
    let mut metadata = json::read(&bytes)?.value;
    let mut changed = Vec::new();
    for entry in file_entry::all(&mut metadata) {
        update(root, entry, &mut changed)?;
    }
    if !changed.is_empty() {
        replace(folder, canonical::json_string(&metadata).as_bytes())?;
    }
    Ok(changed)
}

/// Locks the folder of a URDD. `None` if its parent folder is not writable: then no other run can replace it.
pub(crate) fn lock(folder: &Path) -> Option<TargetLock> {
    let place = fs::canonicalize(folder).ok()?;
    TargetLock::acquire(&place, &Cancellation::default()).ok()
}

/// Replaces `urdd.json`, so that readers see either the old or the new one.
pub(crate) fn replace(folder: &Path, text: &[u8]) -> io::Result<()> {
    let file = Path::new(ROOT_METADATA);
    let staging = Staging::begin_among(&folder.join(file)).map_err(|error| match error {
        StagingError::Write { error, .. } => error,
        error => io::Error::other(error),
    })?;
    Writer::new(staging.content()).synced(file, text)?;
    staging.put_among(folder, &[file]).map_err(|(_, error)| error)
}

fn update(root: &Root, entry: &mut Value, changed: &mut Vec<String>) -> Result<(), RehashError> {
    let Some(path) = file_entry::path(entry).map(str::to_owned) else {
        return Ok(());
    };
    let (size, sha256) =
        digest::of(root, &path).map_err(|error| RehashError::File { path: path.clone(), error })?;
    if file_entry::update(entry, size, &sha256) {
        changed.push(path);
    }
    Ok(())
}
