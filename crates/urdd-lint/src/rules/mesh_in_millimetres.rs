use super::prelude::*;

declare_lint! {
    /// A mesh is a hundred times as long as the robot's joints are apart, or shorter than a millimetre.
    ///
    /// It is in millimetres, or was scaled to metres twice. RViz shows nothing, because the camera is inside of the mesh; planners see
    /// everything in collision.
    ///
    /// Write `scale="0.001 0.001 0.001"`, or remove a scale that is wrong, or export the mesh in metres.
    LNT022 "mesh-in-millimetres", Error, WrongPlace, since "1.1.0"
}

/// The shortest mesh, m.
const SHORTEST: f64 = 0.001;
const REMOVE: &str = "if it is in metres, remove the scale";

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    if !urdf.moves() {
        return Some(());
    }
    let longest = urdf.longest_part(findings)?;
    for (node, mesh) in urdf.read_meshes(findings)? {
        let Ok(facts) = mesh.facts else { continue };
        let scale = Vector3::from(mesh.scale);
        let size = diagonal(facts.solid.corners.iter().map(|one| one.component_mul(&scale)));
        let largest = mesh.scale.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let (what, advice) = if size > longest {
            let advice = match largest > 1.0 {
                true => REMOVE,
                false => "if it is in millimetres, write scale=\"0.001 0.001 0.001\"",
            };
            ("far more than the robot", advice)
        } else if size < SHORTEST {
            let advice = match largest < 1.0 {
                true => REMOVE,
                false => "export it in metres, or write the scale that makes it so",
            };
            ("less than a millimetre", advice)
        } else {
            continue;
        };
        let message = format!("the mesh is {} long, {what}; {advice}", metres(size));
        urdf.at_attribute(node, "filename", message).report(findings);
    }
    Some(())
}
