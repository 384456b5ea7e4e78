//! File names of derived meshes: SPEC 7.3.

use crate::settings::MeshFormats;
use urdd_format::meshes::MeshFiles;
use urdd_format::registry::ModuleKind;

/// Maximum length of a slug in characters.
const LONGEST: usize = 64;

/// The part of a file name that identifies the link.
fn slug(link: &str) -> String {
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
    match slug.is_empty() {
        true => "link".to_owned(),
        false => slug,
    }
}

/// The files of a link's mesh, or of one of its pieces.
pub(crate) fn mesh_files(
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slugs_are_ascii_and_short() {
        assert_eq!(slug("arm/left_link-2"), "arm_left_link-2");
        assert_eq!(slug("a \u{e9}\u{4f60}b"), "a_b");
        assert_eq!(slug(""), "link");
        assert_eq!(slug("\u{4f60}"), "_");
        assert_eq!(slug(&"x".repeat(99)), "x".repeat(64));
    }

    #[test]
    fn pieces_lie_in_a_folder_of_their_link() {
        let files = mesh_files(ModuleKind::PlainMeshes, 3, "a b", None, MeshFormats::default());
        assert_eq!(
            files.obj.as_deref(),
            Some("mesh_modules/plain_meshes_module/meshes/obj/3_a_b.obj")
        );
        let kind = ModuleKind::ConvexDecompositionMeshes;
        let files = mesh_files(kind, 3, "a", Some(12), MeshFormats::default());
        assert_eq!(
            files.glb,
            "mesh_modules/convex_decomposition_meshes_module/meshes/glb/3_a/12.glb"
        );
    }
}
