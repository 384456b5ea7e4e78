//! The sources of a recipe's parts, which of them may run as programs, and the documents of those that are URDDs.
//!
//! A recipe may come from a stranger, together with its folder. It therefore uses only parts in that folder and runs no
//! program, unless the user allows more.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use super::error::{PartFault, Result};
use super::recipe::{Part, Recipe, Sources};
use crate::Settings;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::file_type::{FileType, is_archive};
use urdd_directory::json;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::root::Root;
use urdd_directory::source::is_urdd;
use urdd_format::escape;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SourceKind {
    /// A URDD of version 1: a folder or an archive.
    Urdd,
    /// A URDD from before version 1, which is used through the URDF in it.
    Legacy,
    Urdf,
}

fn source_kind(path: &Path) -> Result<SourceKind, PartFault> {
    if path.is_dir() {
        return match (is_urdd(path), path.join(ROOT_METADATA).is_file()) {
            (_, true) => Ok(SourceKind::Urdd),
            (true, false) => Ok(SourceKind::Legacy),
            (false, false) => Err(missing("this folder holds none")),
        };
    }
    match (path.is_file(), is_archive(path)) {
        (true, true) => Ok(SourceKind::Urdd),
        (true, false) => Ok(SourceKind::Urdf),
        (false, _) => Err(missing("nothing is there")),
    }
}

fn missing(why: &str) -> PartFault {
    PartFault::unusable(format!(
        "there is no such URDD or URDF: {why}; a source is a folder or zip archive of a URDD, or a URDF or xacro file, relative to the recipe"
    ))
}

/// The source of a part that may be read.
pub(super) struct Source {
    /// Its path; symbolic links are resolved unless the user named it.
    pub path: PathBuf,
    pub kind: SourceKind,
}

impl Recipe {
    /// The source of a part.
    /// Fails if it does not exist, is outside the folders from which the recipe may use parts, or is a xacro file that may
    /// not run.
    pub(super) fn source(&self, part: &Part, settings: &Settings) -> Result<Source> {
        self.allowed(&part.source, settings).map_err(|fault| part.refused(fault))
    }

    fn allowed(&self, source: &Path, settings: &Settings) -> Result<Source, PartFault> {
        let Sources::In(folder) = &self.sources else {
            return Ok(Source { path: source.to_owned(), kind: source_kind(source)? });
        };
        let path = source.canonicalize().map_err(|_| missing("nothing is there"))?;
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.clone());
        let mut allowed =
            settings.source.allowed_folders.iter().filter_map(|folder| folder.canonicalize().ok());
        if !path.starts_with(&folder) && !allowed.any(|folder| path.starts_with(folder)) {
            let shown = |path: &Path| path.display().to_string();
            let [found, folder, allow] =
                [&path, &folder, path.parent().unwrap_or(&path)].map(shown);
            return Err(PartFault::unusable(format!(
                "this is {}, outside of {}, the folder of the recipe; to use parts from there, add --allow-folder {}",
                escape::line(&found),
                escape::line(&folder),
                escape::shell(&allow)
            )));
        }
        let kind = source_kind(&path)?;
        let is_xacro = FileType::Xacro.is_of(&path);
        match kind == SourceKind::Urdf && is_xacro && !settings.source.xacro.expand_urdf {
            true => Err(PartFault::unusable(
                "the recipe names a xacro file, which runs as a program; if you trust it, allow it with --xacro",
            )),
            false => Ok(Source { path, kind }),
        }
    }
}

/// A JSON document of a URDD, with its length in bytes.
pub(super) fn document<T: DeserializeOwned>(
    root: &Root,
    path: &str,
) -> Result<(T, usize), PartFault> {
    let bytes = bytes(root, path)?;
    Ok((parsed(&bytes, path)?, bytes.len()))
}

pub(super) fn bytes(root: &Root, path: &str) -> Result<Vec<u8>, PartFault> {
    root.read(path, MAX_DOCUMENT_BYTES).map_err(|error| PartFault::unreadable(path, error))
}

/// The value of a JSON document; `path` names it in faults.
pub(super) fn parsed<T: DeserializeOwned>(bytes: &[u8], path: &str) -> Result<T, PartFault> {
    let value = json::read(bytes).map_err(|error| PartFault::unreadable(path, error))?;
    T::deserialize(&value.value).map_err(|error| PartFault::unreadable(path, error))
}
