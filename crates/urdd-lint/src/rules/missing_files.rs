use percent_encoding::percent_decode_str;

use super::prelude::*;
use crate::named_file::NamedFile;
use urdd_format::escape;
use urdd_source::Files;

declare_lint! {
    /// A mesh is not there.
    ///
    /// Programs refuse the robot, or have no shape there. RViz shows nothing at that place, and planners see no
    /// collision. A mesh of a package that is not found is LNT037's, unless a package or folder of a near name has it: write that
    /// name, or rename the folder. A file that is there, outside of the robot's folder and packages, is no finding; its shape is
    /// read with `--allow-folder`.
    ///
    /// Correct the name, or add the file. A relative name is relative to the URDF.
    LNT029 "mesh-not-found", Error, MissingGeometry, since "1.1.0" => mesh_not_found;

    /// A package that the URDF names is not found.
    ///
    /// It may be installed elsewhere: then name it, `--package NAME=FOLDER`, or set ROS_PACKAGE_PATH or AMENT_PREFIX_PATH. Rules
    /// about geometry do not look at links whose meshes are in it.
    ///
    /// Correct the name, or say where the package is.
    LNT037 "package-not-found", Info, MissingGeometry, since "1.1.0", off by default => package_not_found;

    /// A texture of a mesh or of a `<material>`, or the material library of an OBJ, is not there.
    ///
    /// The part is white or grey. Meshcat and Drake warn. Textures of a package that is not found are LNT037's.
    ///
    /// Add the file, or correct the name in the mesh or in the URDF. A mesh names files beside itself.
    LNT030 "texture-missing", Info, Appearance, since "1.1.0" => texture_missing
}

/// How far up to look for a name that is relative to a folder above the URDF.
const LEVELS: usize = 6;

fn mesh_not_found(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Err(missing) = &mesh.file else { continue };
        let file = NamedFile { node, name: &mesh.filename };
        // Other rules say these.
        if missing.other_case.is_some()
            || missing.no_package.is_some() && !missing.is_in_near_package()
            || missing.outside.is_some()
            || file.is_absolute()
            || file.is_on_a_host()
        {
            continue;
        }
        let mut above = urdf.folder.ancestors().skip(1).take(LEVELS);
        let is_plain = !mesh.filename.contains("://");
        let above =
            above.find(|folder| is_plain && urdf.files.is_file(&folder.join(&mesh.filename)));
        let near = missing.near_package.as_ref().zip(missing.no_package.as_ref());
        let near = near.map(|(near, package)| near.in_words(package));
        let message = near.unwrap_or_else(|| match above {
            Some(folder) => format!(
                "the file is there only from the folder `{}` above, where few programs look; name it relative to the URDF",
                folder.file_name().unwrap_or_default().to_string_lossy()
            ),
            None if mesh.filename.starts_with("package:///") => {
                "the name has no package, which stands after `package://`; write it".to_owned()
            }
            None => "the file is not there; correct the name, or add the file".to_owned(),
        });
        urdf.at_attribute(node, "filename", message).actual(&mesh.filename).report(findings);
    }
    Some(())
}

fn package_not_found(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let mut told = BTreeSet::new();
    let meshes = urdf.meshes(findings)?;
    let textures = textures(urdf, findings)?;
    let of_meshes = meshes.into_iter().map(|(node, mesh)| (node, mesh.file.clone()));
    let of_textures = textures.into_iter().map(|texture| (texture.named.node, texture.file));
    for (node, file) in of_meshes.chain(of_textures) {
        let Some((package, near)) = file.err().and_then(|missing| {
            // LNT029 says these.
            let is_said = node.tag_name().name() == "mesh" && missing.is_in_near_package();
            Some((missing.no_package.filter(|_| !is_said)?, missing.near_package))
        }) else {
            continue;
        };
        if told.insert(package.clone()) {
            let message = near.map(|near| near.in_words(&package)).unwrap_or_else(|| {
                format!(
                    "there is no package `{package}` at or above the URDF; say where it is: --package {}=FOLDER",
                    escape::shell(&package)
                )
            });
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}

fn texture_missing(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let (Ok(facts), GeometryKind::Visual) = (mesh.facts, mesh.kind) else { continue };
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
        let (Err(missing), named) = (texture.file, texture.named) else { continue };
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
        let message = "the texture is not there; correct the name, or add the file";
        let finding = urdf.at_attribute(named.node, "filename", message);
        finding.actual(named.name).report(findings);
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
