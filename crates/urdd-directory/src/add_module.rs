//! Adds a module of one's own to a URDD: its folder, and its entry in `urdd.json`.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;
use thiserror::Error;

use super::canonical;
use super::discover::ROOT_METADATA;
use super::json;
use super::limits::MAX_DOCUMENT_BYTES;
use super::module_entry;
use super::rehash::{lock, replace};
use super::root::{ReadError, Root};
use super::staging::{Staging, StagingError};
use super::text_fault::UnreadableText;
use super::writer::Writer;
use crate::cancellation::Cancellation;
use urdd_format::registry::ModuleKind;

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
    module_entry::insert(modules, name, version, name, depends_on, own);

    let folder = write_folder(parent, name, files)?;
    if let Err(error) = replace(parent, canonical::json_string(&metadata).as_bytes()) {
        let _ = fs::remove_dir_all(&folder);
        return Err(AddModuleError::Write { path: parent.join(ROOT_METADATA), error });
    }
    Ok(folder)
}
