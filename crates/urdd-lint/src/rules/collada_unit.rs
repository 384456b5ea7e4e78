use super::prelude::*;

declare_lint! {
    /// A COLLADA file is not in metres.
    ///
    /// RViz, Gazebo and PyBullet's collisions multiply by the file's unit; Pinocchio and trimesh, so yourdfpy, do not. The part has
    /// different sizes in different programs. `urdd` multiplies, as the format demands.
    ///
    /// Export the mesh in metres, with `<unit meter="1"/>`.
    LNT031 "collada-unit", Warning, WrongPlace, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Ok(facts) = mesh.facts else { continue };
        if facts.notes.iter().any(|note| note.code == NoteCode::UnitApplied) {
            let message = "the mesh is not in metres, and programs differ in whether they convert it; export it in metres";
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}
