use super::prelude::*;
use urdd_directory::limits::MAX_DOCUMENT_BYTES;
use urdd_directory::regular;

declare_lint! {
    /// Two different collision meshes have one file name in different folders.
    ///
    /// MuJoCo before 4.0 drops the folders of names in a URDF, and takes one mesh for both links without a word.
    ///
    /// Rename one of the files.
    LNT032 "mesh-names-clash", Info, Collisions, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let mut by_name: BTreeMap<&std::ffi::OsStr, Vec<(_, &Path)>> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for (node, mesh) in urdf.read_meshes(findings)? {
        if let (GeometryKind::Collision, Some(name)) = (mesh.kind, mesh.file.file_name())
            && seen.insert(mesh.file)
        {
            by_name.entry(name).or_default().push((node, mesh.file));
        }
    }
    for files in by_name.into_values().filter(|files| files.len() > 1) {
        let bytes = |file: &Path| regular::read(file, MAX_DOCUMENT_BYTES).ok();
        let Some(((first_node, first), rest)) = files.split_first() else {
            continue;
        };
        let first = bytes(first);
        if let Some((node, _)) = rest.iter().find(|(_, file)| bytes(file) != first) {
            let message = "another collision mesh in another folder has this file name, and MuJoCo before 4.0 takes one for both; \
                rename one of them";
            let first = urdf.at_attribute(*first_node, "filename", "the other mesh is here");
            urdf.at_attribute(*node, "filename", message).related(first).report(findings);
        }
    }
    Some(())
}
