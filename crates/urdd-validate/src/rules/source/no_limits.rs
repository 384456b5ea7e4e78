use crate::rules::prelude::*;

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
    phase References, needs [SourceRobot, Version1],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let file = context.robot_file()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let (name, kind) = (&joint.name, joint.joint_type);
        let needs_limits = matches!(kind, JointType::Revolute | JointType::Prismatic);
        if !needs_limits || joint.mimic.is_some() || joint.position_limits().is_some() {
            continue;
        }
        let actual = match joint.limit {
            None => "no `limit`",
            Some(_) => "a `limit` with neither `lower` nor `upper`",
        };
        let message = format!("joint `{name}` ({kind}) has no limits; it counts as unlimited");
        Finding::at(&file, format!("/joints/{index}/limit"), message)
            .values("`lower` and `upper`", format!("joint `{name}`: {actual}"))
            .report(findings);
    }
    Some(())
}
