use super::prelude::*;

declare_lint! {
    /// A `<ros2_control>` names a joint that the robot does not have.
    ///
    /// `ros2_control_node` ends with `Joint 'X' not found in URDF`, and gz_ros2_control crashed.
    ///
    /// Write the name of a joint, or remove this one.
    LNT043 "ros2-control-unknown-joint", Error, WrongMotion, since "1.1.0"
}

fn check(urdf: &Subject, findings: &mut Findings) -> Option<()> {
    let controls = children(urdf.root).filter(|(name, _)| *name == "ros2_control");
    for (_, control) in controls {
        for (_, joint) in children(control).filter(|(name, _)| *name == "joint") {
            urdf.names_a_joint(joint, findings);
        }
    }
    Some(())
}
