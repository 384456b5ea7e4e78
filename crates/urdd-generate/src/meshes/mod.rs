//! The mesh files that a URDF references, and the derived ones: how they are stored.

pub(crate) mod layout;
pub(crate) mod original;
pub(crate) mod plain;
pub(crate) mod written;

pub use original::MeshCount;

use crate::settings::MeshFormats;
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::ModuleKind;

/// Maximum length of a slug in characters.
const LONGEST: usize = 64;

/// The part of a file name that identifies the link.
pub fn slug(link: &str) -> String {
    let mut slug = String::new();
    let mut in_gap = false;
    for c in link.chars() {
        let kept = c.is_ascii_alphanumeric() || c == '-' || c == '_';
        match (kept, in_gap) {
            (true, _) => slug.push(c),
            (false, false) => slug.push('_'),
            (false, true) => {}
        }
        in_gap = !kept;
    }
    slug.truncate(LONGEST);
    if slug.is_empty() { "link".to_owned() } else { slug }
}

/// The files of a link's mesh, or of one of its pieces: SPEC 7.3.
pub fn mesh_files(
    kind: ModuleKind,
    link_idx: usize,
    link: &str,
    piece_idx: Option<usize>,
    formats: MeshFormats,
) -> MeshFiles {
    let slug = slug(link);
    let path = |extension: &str| {
        let name = match piece_idx {
            None => format!("{link_idx}_{slug}"),
            Some(piece) => format!("{link_idx}_{slug}/{piece}"),
        };
        format!("{}/meshes/{extension}/{name}.{extension}", kind.folder())
    };
    MeshFiles {
        stl: formats.stl.then(|| path("stl")),
        obj: formats.obj.then(|| path("obj")),
        glb: path("glb"),
    }
}
