use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::urdf::JointType;

declare_rule! {
    /// A revolute or prismatic joint has no limits.
    ///
    /// URDF requires `<limit>` of these types. Without it some readers refuse the file, some take
    /// the joint for locked at 0, and in a URDD it is a joint that is not limited. A joint that
    /// follows another needs none.
    ///
    /// Write `<limit lower=… upper=… effort=… velocity=…/>` in the URDF, or make the joint
    /// `continuous` where it turns without end. Then write the URDD again.
    SRC006 "joint-without-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, judges Source, needs [SourceRobot, Version1],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        let needs_limits = matches!(joint.joint_type, JointType::Revolute | JointType::Prismatic);
        if !needs_limits || joint.mimic.is_some() || joint.position_limits().is_some() {
            continue;
        }
        let actual = match joint.limit {
            None => "no `limit`",
            Some(_) => "a `limit` with neither `lower` nor `upper`",
        };
        findings.report(
            Finding::at(
                &file,
                format!("/joints/{index}/limit"),
                format!(
                    "joint `{}` ({}) has no limits; it counts as not limited",
                    joint.name, joint.joint_type
                ),
            )
            .expected("`lower` and `upper`")
            .actual(format!("joint `{}`: {actual}", joint.name)),
        );
    }
}
