//! The sources of a recipe's parts, and which of them may run as programs.
//!
//! A recipe may come from a stranger, together with its folder. It therefore uses only parts in that folder and runs no
//! program, unless the user allows more.

use std::path::{Path, PathBuf};

use super::error::{CombineError, PartFault};
use super::recipe::{Part, Recipe, Sources};
use crate::Settings;
use urdd_directory::discover::ROOT_METADATA;
use urdd_directory::source::{is_archive, is_urdd};

/// The kind of a source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SourceKind {
    /// A URDD of version 1: a folder or an archive.
    Urdd,
    /// A URDD from before version 1, which is used through the URDF in it.
    Legacy,
    /// A URDF or xacro file.
    Urdf,
}

/// The kind of a part's source.
///
/// # Errors
/// If there is none.
pub fn source_kind(path: &Path) -> Result<SourceKind, PartFault> {
    if path.is_dir() {
        return match (is_urdd(path), path.join(ROOT_METADATA).is_file()) {
            (_, true) => Ok(SourceKind::Urdd),
            (true, false) => Ok(SourceKind::Legacy),
            (false, false) => Err(PartFault::Missing("this folder holds none".to_owned())),
        };
    }
    match (path.is_file(), is_archive(path)) {
        (true, true) => Ok(SourceKind::Urdd),
        (true, false) => Ok(SourceKind::Urdf),
        (false, _) => Err(PartFault::Missing("nothing is there".to_owned())),
    }
}

/// The source of a part that may be read.
pub(super) struct Source {
    /// Its path; symbolic links are resolved unless the user named it.
    pub path: PathBuf,
    pub kind: SourceKind,
}

impl Recipe {
    /// The source of a part.
    ///
    /// # Errors
    /// If it does not exist, is outside the folders from which the recipe may use parts, or is a xacro file that may
    /// not run.
    pub(super) fn source(&self, part: &Part, settings: &Settings) -> Result<Source, CombineError> {
        self.allowed(&part.source, settings).map_err(|fault| part.refused(fault))
    }

    fn allowed(&self, source: &Path, settings: &Settings) -> Result<Source, PartFault> {
        let Sources::In(folder) = &self.sources else {
            return Ok(Source { path: source.to_owned(), kind: source_kind(source)? });
        };
        let nothing = |_| PartFault::Missing("nothing is there".to_owned());
        let path = source.canonicalize().map_err(nothing)?;
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.clone());
        let allowed = settings.source.allowed_folders.iter();
        let mut allowed = allowed.filter_map(|folder| folder.canonicalize().ok());
        if !path.starts_with(&folder) && !allowed.any(|folder| path.starts_with(folder)) {
            let shown = |path: &Path| path.display().to_string();
            return Err(PartFault::Outside {
                allow: shown(path.parent().unwrap_or(&path)),
                found: shown(&path),
                folder: shown(&folder),
            });
        }
        let kind = source_kind(&path)?;
        let is_xacro = path.extension().is_some_and(|ending| ending == "xacro");
        match kind == SourceKind::Urdf && is_xacro && !settings.source.xacro.expand_urdf {
            true => Err(PartFault::Xacro),
            false => Ok(Source { path, kind }),
        }
    }
}
