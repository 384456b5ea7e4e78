use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::skip::SkipReason;
use crate::tolerance::{number_tolerance, numbers_agree};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// The velocity or effort limit of a DOF is not the joint's.
    ///
    /// Trajectories are timed by these numbers: too high a limit asks of a motor what it cannot give, and 0
    /// where the URDF says nothing stops the joint for good.
    ///
    /// Copy `velocity` and `effort` of the `limit` of joints of one DOF. Write null where the URDF has none,
    /// and for the DOFs of planar, floating and spherical joints.
    BND005 "speed-or-effort-differs", Error, clause "6.5.4", since "0.1.0",
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
    for (dof, joint) in layout.joint_of_dof.iter().enumerate() {
        let Some(joint) = robot.joints.get(*joint) else {
            continue;
        };
        let limit = joint.limit.filter(|_| joint.num_dofs() == 1);
        for (key, right, written) in [
            (
                "dof_velocity_limits",
                limit.and_then(|limit| limit.velocity),
                bounds.dof_velocity_limits.get(dof),
            ),
            (
                "dof_effort_limits",
                limit.and_then(|limit| limit.effort),
                bounds.dof_effort_limits.get(dof),
            ),
        ] {
            let written = written.copied().flatten();
            let agree = match (right, written) {
                (Some(right), Some(written)) => numbers_agree(right, written),
                (right, written) => right == written,
            };
            if agree {
                continue;
            }
            let finding = Finding::at(
                module.file("module.json"),
                format!("/{key}/{dof}"),
                format!(
                    "this is not what urdf_module says of joint {:?}, which DOF {dof} moves",
                    joint.name
                ),
            )
            .expected(or_null(right))
            .actual(or_null(written));
            findings.report(match (right, written) {
                (Some(right), Some(written)) => finding
                    .tolerance(number_tolerance(right, written))
                    .off_by(right - written, ""),
                _ => finding,
            });
        }
    }
}

fn or_null(number: Option<f64>) -> String {
    number.map_or_else(|| "null".to_owned(), |number| format!("{number:?}"))
}
