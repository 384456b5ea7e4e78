//! Changes a URDD in its folder: sizes and hashes in `urdd.json`, a module of one's own, or some files, all or none.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;
use thiserror::Error;

use crate::cancellation::Cancellation;
use crate::file_type::ROOT_METADATA;
use crate::limits::MAX_DOCUMENT_BYTES;
use crate::position::UnreadableText;
use crate::root::{ReadError, Root};
use crate::staging::{Staging, StagingError};
use crate::take::take_content;
use crate::target_lock::TargetLock;
use crate::unfinished::writing;
use crate::writer::Writer;
use crate::{canonical, file_entry, json};
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
        let Some(path) = file_entry::path(entry).map(str::to_owned) else {
            continue;
        };
        let (size, sha256) = file_entry::of(root, &path)
            .map_err(|error| RehashError::File { path: path.clone(), error })?;
        if file_entry::update(entry, size, &sha256) {
            changed.push(path);
        }
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

    let _writing = writing();
    let folder = write_folder(parent, name, files)?;
    if let Err(error) = replace(parent, canonical::json_string(&metadata).as_bytes()) {
        let _ = fs::remove_dir_all(&folder);
        return Err(AddModuleError::Write { path: parent.join(ROOT_METADATA), error });
    }
    Ok(folder)
}

/// Files by path relative to the root of their URDD.
pub type Files = BTreeMap<String, Vec<u8>>;

/// A pending replacement of files in a folder. It locks out other runs of this program from [`Replacement::begin`] on.
#[derive(Debug)]
pub struct Replacement {
    folder: PathBuf,
    staging: Staging,
}

impl Replacement {
    /// Waits until no other run writes to the folder.
    ///
    /// # Errors
    /// If the parent folder is not writable.
    pub fn begin(folder: &Path) -> Result<Self, StagingError> {
        Ok(Replacement {
            folder: folder.to_owned(),
            staging: Staging::begin_inside(folder, &Cancellation::default())?,
        })
    }

    /// Prepares the new content: these files, plus all others unchanged.
    ///
    /// # Errors
    /// If a file cannot be read or written.
    pub fn stage(&self, files: &Files) -> Result<(), StagingError> {
        let writer = Writer::new(self.staging.content());
        let instead: BTreeSet<&Path> = files.keys().map(Path::new).collect();
        take_content(&self.folder, self.staging.content(), &|path| instead.contains(path))?;
        for (path, bytes) in files {
            writer.file(path, bytes).map_err(|error| match error {
                StagingError::Link { path } => {
                    let below = path.strip_prefix(self.staging.content()).unwrap_or(&path);
                    StagingError::Link { path: self.folder.join(below) }
                }
                error => error,
            })?;
        }
        Ok(())
    }

    /// Moves the new content into place.
    ///
    /// # Errors
    /// If it cannot be moved. The old content is unchanged then.
    pub fn commit(self) -> Result<(), StagingError> {
        self.staging.commit()
    }
}
