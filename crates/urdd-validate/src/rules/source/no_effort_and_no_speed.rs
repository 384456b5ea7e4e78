use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::urdf::JointType;

declare_rule! {
    /// A joint that can move has the limits `effort="0"` and `velocity="0"`.
    ///
    /// By these numbers the joint can neither push nor move. Exporters write them where no number
    /// was given. Planners divide by the speed, controllers clip the effort to 0, and the robot
    /// does not move. A joint that follows another is not meant, nor one whose `lower` equals its
    /// `upper`, nor one that leaves the numbers out.
    ///
    /// Write the joint's real limits into the URDF, or leave both attributes out. Then write the URDD
    /// again.
    SRC009 "no-effort-and-no-speed", Warning, clause "6.1.7", since "0.2.0",
    phase References, judges Source, needs [SourceRobot, Version1],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        let moves = match joint.joint_type {
            JointType::Revolute | JointType::Prismatic => joint
                .position_limits()
                .is_none_or(|(lower, upper)| lower != upper),
            JointType::Continuous => true,
            _ => false,
        };
        let zeros = joint
            .limit
            .is_some_and(|limit| limit.effort == Some(0.0) && limit.velocity == Some(0.0));
        if !moves || !zeros || joint.mimic.is_some() {
            continue;
        }
        findings.report(
            Finding::at(
                &file,
                format!("/joints/{index}/limit"),
                format!(
                    "joint `{}` ({}) has effort 0 and velocity 0: by its limits it cannot move",
                    joint.name, joint.joint_type
                ),
            )
            .expected("the joint's limits, or neither attribute")
            .actual(format!("joint `{}`: effort 0, velocity 0", joint.name)),
        );
    }
}
