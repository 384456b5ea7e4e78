use super::prelude::*;

declare_lint! {
    /// A `<transmission>` names a joint that the robot does not have.
    ///
    /// ros_control says `Could not find joint`, and the controller does not start.
    ///
    /// Write the name of a joint, or remove the transmission.
    LNT042 "transmission-unknown-joint", Error, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let transmissions = children(urdf.root).filter(|(name, _)| *name == "transmission");
    for (_, transmission) in transmissions {
        let joints = transmission.descendants().filter(|node| node.tag_name().name() == "joint");
        for joint in joints {
            urdf.names_a_joint(joint, findings);
        }
    }
    Some(())
}
