use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// `joint_type` of a joint is not the URDF's.
    ///
    /// The type says how many numbers the joint takes from a configuration and what they do. A consumer
    /// of `chain_module` sees no URDF: it moves the joint in the wrong way, and may read the DOFs of
    /// the next joints for this one's.
    ///
    /// Copy the type from `urdf_module`. (A joint without limits that turns is still `Revolute` if the
    /// URDF says so.)
    CHN007 "joint-type-differs", Error, clause "6.3.4", since "0.1.0",
    phase References, needs [Version1, Passed(CHN002)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(chain), Some(module)) = (
        context.robot(),
        context.chain().and_then(|chain| chain.v1),
        context.module(ModuleKind::Chain),
    ) else {
        return findings.skip(SkipReason::NotInThisVersion(ModuleKind::Chain));
    };
    for (index, (joint, right)) in chain.joints_in_chain.iter().zip(&robot.joints).enumerate() {
        if joint.joint_type != right.joint_type {
            findings.report(
                Finding::at(
                    module.file("module.json"),
                    format!("/joints_in_chain/{index}/joint_type"),
                    format!(
                        "joint {index} ({:?}) is of another type in urdf_module",
                        right.name
                    ),
                )
                .expected(right.joint_type)
                .actual(joint.joint_type),
            );
        }
    }
}
