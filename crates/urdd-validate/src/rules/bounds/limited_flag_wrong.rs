use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// `dof_limited` does not say which DOFs the robot's source limits.
    ///
    /// A DOF that is not limited has bounds too, only so that it can be sampled. A program that takes them
    /// for limits will not turn a continuous joint past half a turn; one that takes limits for such bounds
    /// drives a joint into its stops.
    ///
    /// Write true for DOFs of revolute and prismatic joints whose `limit` has `lower` or `upper`, and false
    /// for all others, those of continuous joints included.
    BND004 "limited-flag-wrong", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(layout), Some(bounds), Some(module)) = (
        context.robot(),
        context.dof_layout(),
        context.bounds().and_then(|bounds| bounds.v1),
        context.module(ModuleKind::Bounds),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Bounds));
    };
    let flags = bounds.dof_limited.iter().zip(&layout.joint_of_dof);
    for (dof, (written, joint)) in flags.enumerate() {
        let Some(joint) = robot.joints.get(*joint) else {
            continue;
        };
        let limited = joint.position_limits().is_some();
        if *written != limited {
            let why = match limited {
                true => "has limits in urdf_module".to_owned(),
                false => format!("is a {} joint without position limits", joint.joint_type),
            };
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/dof_limited/{dof}"),
                    format!("DOF {dof} moves joint {:?}, which {why}", joint.name),
                )
                .expected(limited)
                .actual(written),
            );
        }
    }
}
