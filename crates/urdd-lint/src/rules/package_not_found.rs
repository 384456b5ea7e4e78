use std::collections::BTreeSet;

use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_validate::finding::Findings;

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
    for (node, mesh) in urdf.meshes(findings)? {
        let missing = mesh.file.as_ref().err();
        let Some(package) = missing.and_then(|missing| missing.no_package.as_deref()) else {
            continue;
        };
        if told.insert(package) {
            let message = format!(
                "there is no package `{package}` at or above the URDF; say where it is: --package {package}=FOLDER"
            );
            urdf.at_attribute(node, "filename", message)
                .report(findings);
        }
    }
    Some(())
}
