use super::prelude::*;
use urdd_format::escape;

declare_lint! {
    /// A package that the URDF names is not found.
    ///
    /// It may be installed elsewhere: then name it, `--package NAME=FOLDER`, or set ROS_PACKAGE_PATH or AMENT_PREFIX_PATH. Rules
    /// about geometry do not look at links whose meshes are in it.
    ///
    /// Correct the name, or say where the package is.
    LNT037 "package-not-found", Info, MissingGeometry, since "1.1.0", off by default
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
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
