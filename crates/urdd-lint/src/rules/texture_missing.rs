use percent_encoding::percent_decode_str;

use super::prelude::*;
use urdd_source::Files;

declare_lint! {
    /// A texture of a mesh or of a `<material>`, or the material library of an OBJ, is not there.
    ///
    /// The part is white or grey. Meshcat and Drake warn. Textures of a package that is not found are LNT037's.
    ///
    /// Add the file, or correct the name in the mesh or in the URDF. A mesh names files beside itself.
    LNT030 "texture-missing", Info, Appearance, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let (Ok(facts), GeometryKind::Visual) = (mesh.facts, mesh.kind) else {
            continue;
        };
        let folder = mesh.file.parent().unwrap_or(Path::new("."));
        for name in &facts.side_files {
            if !is_there(urdf.files, folder, name) {
                let message = format!(
                    "the mesh names the file `{}`, which is not there; add it beside the mesh",
                    urdd_format::escape::line(name)
                );
                urdf.at_attribute(node, "filename", message).report(findings);
            }
        }
    }
    for texture in textures(urdf, findings)? {
        let (Err(missing), named) = (texture.file, texture.named) else {
            continue;
        };
        // Other rules say these.
        let in_other_case = missing.other_case.is_some_and(|near| near.is_only);
        if in_other_case
            || missing.no_package.is_some()
            || missing.outside.is_some()
            || named.is_absolute()
            || named.is_on_a_host()
            || named.is_fetched()
        {
            continue;
        }
        urdf.at_attribute(
            named.node,
            "filename",
            "the texture is not there; correct the name, or add the file",
        )
        .actual(named.name)
        .report(findings);
    }
    Some(())
}

/// Whether a file is there by its name, as it is or as a URI.
fn is_there(files: &Files, folder: &Path, name: &str) -> bool {
    let plain = name.strip_prefix("file://").or_else(|| name.strip_prefix("file:")).unwrap_or(name);
    let plain = plain.replace('\\', "/");
    let plain = plain.trim();
    let decoded = percent_decode_str(plain).decode_utf8_lossy();
    plain.is_empty()
        || plain.starts_with("data:")
        || files.is_file(&folder.join(plain))
        || files.is_file(&folder.join(&*decoded))
}
