//! The textures that a URDF itself names, in its materials.

use std::path::PathBuf;

use super::named_file::NamedFile;
use super::subject::Subject;
use urdd_findings::finding::Findings;
use urdd_source::MissingMesh;

pub struct Texture<'a> {
    /// Its `<texture>`, and the name there.
    pub named: NamedFile<'a, 'a>,
    /// The file, or why there is none.
    pub file: Result<PathBuf, MissingMesh>,
}

/// The textures of materials, each name once an element. Skips the rule if the URDF describes no robot.
pub fn textures<'a>(urdf: &Subject<'a>, findings: &mut Findings) -> Option<Vec<Texture<'a>>> {
    let source = urdf.source(findings)?;
    let in_material = |file: &NamedFile<'a, 'a>| {
        let above = file.node.parent_element();
        !file.name.trim().is_empty()
            && file.node.tag_name().name() == "texture"
            && above.is_some_and(|above| above.tag_name().name() == "material")
    };
    let named = urdf.named_files().into_iter().filter(in_material);
    let found = named.map(|named| Texture { named, file: source.find(named.name) });
    Some(found.collect())
}
