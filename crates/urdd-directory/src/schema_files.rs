//! Writes the folder of published schemas, and compares it with the types.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::outputs::{self, Output, OutputError, Target};
use urdd_format::schema::{self, RELEASED_PATH, SchemaError, Subject, Variant};

/// Why the folder of schemas could not be written or read.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum SchemaFilesError {
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: io::Error },
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error(transparent)]
    Schema(#[from] SchemaError),
}

/// A difference between the folder of schemas and the types. `path` is the schema's in the folder.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum SchemaFault {
    #[error("{path}: missing")]
    Missing { path: String },
    #[error("{path}: not what the types write")]
    Outdated { path: String },
    #[error("{path}: not a published schema; remove it")]
    Stray { path: String },
    /// A released schema now accepts different documents.
    #[error(
        "{RELEASED_PATH}: a released schema never changes; undo the change, or add a new version of {id} (released as {released}, the types write {found})"
    )]
    Changed { id: String, released: String, found: String },
    #[error(
        "{RELEASED_PATH}: {id} is released and does not exist; a released schema is never removed"
    )]
    Removed { id: String },
}

impl SchemaFault {
    /// Whether `urdd schema export` fixes it. If not, the message says how to fix it.
    pub fn is_mended_by_export(&self) -> bool {
        matches!(self, SchemaFault::Missing { .. } | SchemaFault::Outdated { .. })
    }
}

/// Writes every schema into `folder`, and creates it if needed. Skips files that are up to date. Returns the number of
/// files written.
///
/// # Errors
/// If a file or folder cannot be written.
pub fn export(folder: &Path, variant: Variant) -> Result<usize, SchemaFilesError> {
    let files = schema::files(variant);
    let outputs = files.iter().map(|file| Output {
        path: (&file.path).into(),
        bytes: file.text.as_bytes(),
        replaces: true,
    });
    Ok(outputs::write(Target::Folder(folder), outputs.collect())?)
}

/// Compares `folder` with the types, and the types with the released schemas. Ignores files whose names begin with a
/// dot.
///
/// # Errors
/// If the folder cannot be read.
pub fn check(folder: &Path) -> Result<Vec<SchemaFault>, SchemaFilesError> {
    let mut found = BTreeMap::new();
    read_folder(folder, "", &mut found)?;

    let mut faults = Vec::new();
    for file in schema::files(Variant::Strict) {
        match found.remove(&file.path) {
            None => faults.push(SchemaFault::Missing { path: file.path }),
            Some(bytes) if !same_text(&bytes, &file.text) => {
                faults.push(SchemaFault::Outdated { path: file.path });
            }
            Some(_) => {}
        }
    }
    faults.extend(found.into_keys().map(|path| SchemaFault::Stray { path }));
    faults.extend(frozen_faults()?);
    Ok(faults)
}

fn frozen_faults() -> Result<Vec<SchemaFault>, SchemaFilesError> {
    let mut faults = Vec::new();
    for release in schema::released()? {
        let Ok(subject) = Subject::find(&release.id) else {
            faults.push(SchemaFault::Removed { id: release.id });
            continue;
        };
        let found = schema::validating_hash(&subject.schema(Variant::Strict));
        if found != release.sha256 {
            faults.push(SchemaFault::Changed { id: release.id, released: release.sha256, found });
        }
    }
    Ok(faults)
}

/// Ignores line endings: a checkout may have converted them.
fn same_text(bytes: &[u8], text: &str) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|found| found.replace("\r\n", "\n") == text)
}

fn read_folder(
    folder: &Path,
    prefix: &str,
    found: &mut BTreeMap<String, Vec<u8>>,
) -> Result<(), SchemaFilesError> {
    let entries = fs::read_dir(folder).map_err(|source| io_error(folder, source))?;
    for entry in entries {
        let entry = entry.map_err(|source| io_error(folder, source))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if name.starts_with('.') {
            continue;
        }
        let path = entry.path();
        let kind = entry.file_type().map_err(|source| io_error(&path, source))?;
        if kind.is_dir() {
            read_folder(&path, &format!("{prefix}{name}/"), found)?;
        } else {
            let bytes = fs::read(&path).map_err(|source| io_error(&path, source))?;
            found.insert(format!("{prefix}{name}"), bytes);
        }
    }
    Ok(())
}

fn io_error(path: &Path, source: io::Error) -> SchemaFilesError {
    SchemaFilesError::Io { path: path.to_owned(), source }
}
