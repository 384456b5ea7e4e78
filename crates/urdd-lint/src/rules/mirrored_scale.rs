use super::prelude::*;

declare_lint! {
    /// The scale of a collision mesh mirrors it, or flattens it.
    ///
    /// A mirrored mesh has its faces inside out, and Gazebo's collisions fail with it. MuJoCo 4 and trimesh turn the faces.
    /// Two negative factors are a rotation, and no finding. With a factor of 0 on a
    /// collision mesh, MuJoCo refuses the robot.
    ///
    /// Export a mirrored mesh, and write positive factors.
    LNT023 "mirrored-scale", Warning, Collisions, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    for (node, mesh) in urdf.meshes(findings)? {
        let Some([x, y, z]) = numbers::<3>(node, "scale") else {
            continue;
        };
        let is_collision = mesh.geometry == GeometryKind::Collision;
        let is_flat = [x, y, z].contains(&0.0);
        let message = if is_flat {
            "a factor of 0 flattens the mesh; write what it is to be multiplied by"
        } else if x.signum() * y.signum() * z.signum() < 0.0 && is_collision {
            "the scale mirrors the mesh, so that its faces are inside out; export a mirrored mesh"
        } else {
            continue;
        };
        urdf.at_attribute(node, "scale", message).report(findings);
    }
    Some(())
}
