use super::prelude::*;

declare_lint! {
    /// A collision mesh has more than 50,000 triangles.
    ///
    /// Collision checks take long, and so does loading: PR2's took 30 s. MuJoCo refuses a robot
    /// with an STL of more than 200,000.
    /// PyBullet loads a part of a large one. Common robots have 100 to 5,000 a link.
    ///
    /// Take the convex hull, or a few boxes. `urdd generate` makes convex pieces.
    LNT024 "heavy-collision-mesh", Info, Collisions, since "1.1.0"
}

const MANY: usize = 50_000;

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Ok(facts) = mesh.facts else { continue };
        // PyBullet is asked for the triangles: scenery that robots move in.
        let is_concave = |above: Node<'_, '_>| above.attribute("concave") == Some("yes");
        if mesh.kind == GeometryKind::Collision
            && facts.triangles > MANY
            && !node.ancestors().any(is_concave)
        {
            let message = format!(
                "the collision mesh has {} triangles; take its convex hull, or a few boxes",
                facts.triangles
            );
            urdf.at_attribute(node, "filename", message).report(findings);
        }
    }
    Some(())
}
