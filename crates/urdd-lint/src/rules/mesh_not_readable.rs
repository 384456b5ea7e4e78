use crate::rule::declare_lint;
use crate::subject::Subject;
use urdd_validate::finding::Findings;

declare_lint! {
    /// A mesh is there, but holds no triangles that can be read.
    ///
    /// Every program refuses it. Often the file is a pointer of Git LFS: the mesh itself was not fetched.
    ///
    /// Export the mesh again, or fetch it: `git lfs pull`.
    LNT035 "mesh-not-readable", Error, MissingGeometry, since "1.1.0"
}

/// Formats that are read here. Nobody reads all of the others.
const READ: [&str; 5] = ["stl", "dae", "obj", "gltf", "glb"];

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Err(reason) = mesh.facts else { continue };
        let ending = mesh
            .file
            .extension()
            .unwrap_or_default()
            .to_string_lossy()
            .to_lowercase();
        if READ.contains(&ending.as_str()) {
            let message =
                format!("the mesh cannot be read: {reason}; export it again, or fetch it");
            urdf.at_attribute(node, "filename", message)
                .report(findings);
        }
    }
    Some(())
}
