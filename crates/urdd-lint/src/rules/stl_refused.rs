use super::prelude::*;

declare_lint! {
    /// An STL is text, or is cut off.
    ///
    /// MuJoCo refuses the robot if it is a collision mesh. PyBullet loads the link without its collision shape, and says so in its log alone.
    /// Pinocchio and yourdfpy read text.
    ///
    /// Export the mesh as binary STL.
    LNT034 "stl-refused", Warning, Collisions, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Ok(facts) = mesh.facts else { continue };
        let is_cut = facts.notes.iter().any(|note| note.code == NoteCode::CutOff);
        let message = match facts.format {
            Format::StlAscii => "the STL is text; export it as binary STL",
            Format::StlBinary if is_cut => "the STL is cut off; export it again",
            _ => continue,
        };
        urdf.at_attribute(node, "filename", message).report(findings);
    }
    Some(())
}
