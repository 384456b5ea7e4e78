use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;

declare_rule! {
    /// The lower limit of a joint is above its upper limit.
    ///
    /// No position is within the limits. Planners find no configuration, and programs that clamp a
    /// position to the limits disagree. Where one of the two limits is absent, it is 0.
    ///
    /// Swap or correct `lower` and `upper` in the URDF, and write the URDD again.
    SRC001 "crossed-limits", Warning, clause "6.1.7", since "0.1.0",
    phase References, judges Source, needs [SourceRobot],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(file)) = (context.robot(), context.robot_file()) else {
        return;
    };
    for (index, joint) in robot.joints.iter().enumerate() {
        let (Some((lower, upper)), Some(limit)) = (joint.position_limits(), joint.limit) else {
            continue;
        };
        if lower > upper {
            let absent = match (limit.lower, limit.upper) {
                (None, _) => " (`lower` is absent, which means 0)",
                (_, None) => " (`upper` is absent, which means 0)",
                _ => "",
            };
            findings.report(
                Finding::at(
                    &file,
                    format!("/joints/{index}/limit"),
                    format!(
                        "the limits of joint `{}` are crossed{absent}: no position is allowed",
                        joint.name
                    ),
                )
                .expected("lower <= upper")
                .actual(format!("joint `{}`: {lower} > {upper}", joint.name)),
            );
        }
    }
}
