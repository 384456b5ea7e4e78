use crate::rules::prelude::*;

declare_rule! {
    /// A mimic joint names a joint that does not exist.
    ///
    /// The joint has no DOF of its own and nothing to follow, so its position is unknown. Most often
    /// the driver was renamed, or its part of the robot was left out. (`<mimic>` on a fixed joint has no
    /// meaning and is ignored.)
    ///
    /// Correct `joint` of the `<mimic>`, or remove the `<mimic>`, in the URDF. Then write the URDD again.
    URD008 "unknown-mimic-driver", Error, clause "6.1.5", since "0.1.0",
    phase References, needs [Module(Kind::Urdf), Passed(URD003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        if let Some(mimic) = joint.active_mimic()
            && robot.joint(&mimic.joint).is_none()
        {
            let name = &joint.name;
            let message = format!("joint `{name}` follows a joint that the robot does not have");
            Finding::at(&file, format!("/joints/{index}/mimic/joint"), message)
                .values("the name of a joint", format!("`{}`", mimic.joint))
                .report(findings);
        }
    }
    Some(())
}
