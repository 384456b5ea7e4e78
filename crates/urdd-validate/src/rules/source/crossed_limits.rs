use crate::rules::prelude::*;

declare_rule! {
    /// The lower limit of a joint is above its upper limit.
    ///
    /// No position is within the limits. Planners find no configuration, and programs that clamp a
    /// position to the limits disagree. Where one of the two limits is absent, it is 0.
    ///
    /// Swap or correct `lower` and `upper` in the URDF, and write the URDD again.
    SRC001 "crossed-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, needs [SourceRobot], of Robot,
}

fn check(described: &Described, findings: &mut Findings) -> Option<()> {
    let robot = described.robot()?;
    for (index, joint) in robot.joints.iter().enumerate() {
        let limits = joint.position_limits().zip(joint.limit);
        if let Some(((lower, upper), limit)) = limits
            && lower > upper
        {
            let name = &joint.name;
            let absent = match (limit.lower, limit.upper) {
                (None, _) => " (`lower` is absent, which means 0)",
                (_, None) => " (`upper` is absent, which means 0)",
                _ => "",
            };
            let message =
                format!("the limits of joint `{name}` are crossed{absent}: no position is allowed");
            finding_in(described, format!("/joints/{index}/limit"), message)
                .values("lower <= upper", format!("joint `{name}`: {lower} > {upper}"))
                .report(findings);
        }
    }
    Some(())
}
