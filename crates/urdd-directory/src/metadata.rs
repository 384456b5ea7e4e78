//! Changes `urdd.json` of a URDD: updates sizes and hashes to match the files, or adds a module of one's own.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

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
use super::text_fault::UnreadableText;
use super::writer::Writer;
use crate::cancellation::Cancellation;
use urdd_format::registry::ModuleKind;

/// Why the hashes could not be updated.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum RehashError {
    #[error("{ROOT_METADATA}: {0}")]
    Metadata(ReadError),
    #[error("{ROOT_METADATA} is not JSON: {0}; run `urdd validate` for details")]
    NotJson(#[from] UnreadableText),
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
fn lock(folder: &Path) -> Option<TargetLock> {
    let place = fs::canonicalize(folder).ok()?;
    TargetLock::acquire(&place, &Cancellation::default()).ok()
}

/// Replaces `urdd.json`, so that readers see either the old or the new one.
fn replace(folder: &Path, text: &[u8]) -> io::Result<()> {
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

/// Why a module could not be added. Nothing is changed then.
#[derive(Debug, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum AddModuleError {
    #[error("{} exists, and is left as it is: take another name, or remove it first", .0.display())]
    Exists(PathBuf),
    #[error("{ROOT_METADATA} lists `{0}` already: take another name, or remove the entry first")]
    Listed(String),
    #[error("{ROOT_METADATA}: {0}")]
    Metadata(ReadError),
    #[error("{ROOT_METADATA} is not JSON: {0}; run `urdd validate` for details")]
    NotJson(#[from] UnreadableText),
    #[error("{ROOT_METADATA} has no list `modules`; run `urdd validate` for details")]
    NoModules,
    #[error("zip archives are read only; unpack it, add the module, and pack it again")]
    NotAFolder,
    #[error("{}: {error}", path.display())]
    Write { path: PathBuf, error: io::Error },
    #[error(transparent)]
    Folder(#[from] StagingError),
}

/// Writes a folder with these files into `parent`: all of them or none.
///
/// # Errors
/// If something of the folder's name exists, or a file cannot be written.
pub fn write_folder(
    parent: &Path,
    name: &str,
    files: &[(&str, String)],
) -> Result<PathBuf, AddModuleError> {
    let folder = parent.join(name);
    let staging = Staging::begin(&folder, &Cancellation::default())?;
    // Of all that create the folder at once, one succeeds.
    if fs::symlink_metadata(&folder).is_ok() {
        return Err(AddModuleError::Exists(folder));
    }
    let writer = Writer::new(staging.content());
    for (name, text) in files {
        writer.file(name, text.as_bytes())?;
    }
    staging.commit()?;
    Ok(folder)
}

/// Writes a module into the folder of a URDD and lists it in `urdd.json`, after the modules of the specification, by
/// name.
///
/// # Errors
/// If the URDD has or lists a module of this name, `urdd.json` cannot be read, or something cannot be written.
pub fn add_module(
    root: &Root,
    name: &str,
    version: &str,
    depends_on: &[ModuleKind],
    files: &[(&str, String)],
) -> Result<PathBuf, AddModuleError> {
    let parent = root.folder().ok_or(AddModuleError::NotAFolder)?;
    let _lock = lock(parent);
    let bytes = root.read(ROOT_METADATA, MAX_DOCUMENT_BYTES).map_err(AddModuleError::Metadata)?;
    let mut metadata = json::read(&bytes)?.value;
    let modules = metadata.get_mut("modules").and_then(Value::as_array_mut);
    let modules = modules.ok_or(AddModuleError::NoModules)?;
    let is_there = |module: &Value| module["name"] == name || module["path"] == name;
    if modules.iter().any(is_there) {
        return Err(AddModuleError::Listed(name.to_owned()));
    }
    let own = files.iter().map(|(file, text)| (format!("{name}/{file}"), text.as_bytes()));
    file_entry::insert_module(modules, name, version, name, depends_on, own);

    let folder = write_folder(parent, name, files)?;
    if let Err(error) = replace(parent, canonical::json_string(&metadata).as_bytes()) {
        let _ = fs::remove_dir_all(&folder);
        return Err(AddModuleError::Write { path: parent.join(ROOT_METADATA), error });
    }
    Ok(folder)
}
