use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// A mimic joint names a joint that does not exist.
    ///
    /// The joint has no DOF of its own and nothing to follow, so its position is unknown. Most often
    /// the driver was renamed, or its part of the robot was left out. (`<mimic>` on a fixed joint has no
    /// meaning and is ignored.)
    ///
    /// Correct `joint` of the `<mimic>`, or remove the `<mimic>`, in the URDF. Then write the URDD again.
    URD008 "unknown-mimic-driver", Error, clause "6.1.5", since "0.1.0",
    phase References, judges Robot, needs [Module(Kind::Urdf), Passed(URD003)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        let Some(mimic) = joint.active_mimic() else {
            continue;
        };
        if robot.joint(&mimic.joint).is_none() {
            findings.report(
                Finding::at(
                    file.clone(),
                    format!("/joints/{index}/mimic/joint"),
                    format!(
                        "joint `{}` follows a joint that the robot does not have",
                        joint.name
                    ),
                )
                .expected("the name of a joint")
                .actual(format!("`{}`", mimic.joint)),
            );
        }
    }
}
