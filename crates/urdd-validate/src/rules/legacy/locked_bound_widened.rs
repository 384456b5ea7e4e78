use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::rules::bounds::LEGACY_WIDENING;
use crate::tolerance::numbers_agree;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// The upper bound of a joint whose two limits are equal was raised by 1e-7.
    ///
    /// Published modules never have equal bounds. The joint stays locked for every purpose, but a program
    /// that looks for lower = upper does not see it. (Where published modules could not distinguish absent limits
    /// from zeros, the joint may also have no limits and be frozen by mistake: look into its URDF.)
    ///
    /// Nothing needs to be done. From version 1 on, a locked joint has equal bounds.
    LEG006 "locked-bound-widened", Info, clause "10.3", since "0.1.0",
    phase References, needs [Legacy, Passed(DOF005), Passed(BND002)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(layout), Some(bounds), Some(module)) = (
        context.robot(),
        context.dof_layout(),
        context.bounds(),
        context.module(ModuleKind::Bounds),
    ) else {
        return;
    };
    for (dof, (pair, joint)) in bounds.bounds.iter().zip(&layout.joint_of_dof).enumerate() {
        let Some(joint) = robot.joints.get(*joint) else {
            continue;
        };
        let Some((lower, upper)) = joint.position_limits() else {
            continue;
        };
        let [_, written] = *pair;
        let raised = upper + LEGACY_WIDENING;
        if lower == upper && !numbers_agree(upper, written) && numbers_agree(raised, written) {
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/bounds/{dof}/1"),
                    format!(
                        "joint {:?} is locked at {upper:?}; its upper bound was raised by {LEGACY_WIDENING:?}",
                        joint.name
                    ),
                )
                .expected(format!("{upper:?}"))
                .actual(format!("{written:?}")),
            );
        }
    }
}
