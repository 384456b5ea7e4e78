use super::prelude::*;
use crate::geometry::is_read_here;

declare_lint! {
    /// A mesh is there, but holds no triangles that can be read.
    ///
    /// Every program refuses it. Often the file is a pointer of Git LFS: the mesh itself was not fetched.
    ///
    /// Export the mesh again, or fetch it: `git lfs pull`.
    LNT035 "mesh-not-readable", Error, MissingGeometry, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Err(reason) = mesh.facts else { continue };
        if is_read_here(mesh.file) {
            // Most reasons of the reader end with what to do.
            let advice = if reason.contains("; ") { "" } else { "; export the mesh again" };
            let message = format!("the mesh cannot be read: {reason}{advice}");
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}
