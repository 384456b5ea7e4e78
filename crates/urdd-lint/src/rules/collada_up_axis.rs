use super::prelude::*;

declare_lint! {
    /// A COLLADA file says that another axis than z is up.
    ///
    /// Robotics programs ignore it: RViz, MoveIt, Pinocchio, PyBullet, trimesh, and `urdd`. Others turn the mesh, such as
    /// Foxglove.
    ///
    /// Export the mesh with z up, as it is to be in the link.
    LNT053 "collada-up-axis", Info, WrongPlace, since "1.1.0", off by default
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Ok(facts) = mesh.facts else { continue };
        if facts.notes.iter().any(|note| note.code == NoteCode::UpAxisIgnored) {
            let message = "the mesh says that another axis than z is up, and some viewers turn it; export it with z up";
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}
