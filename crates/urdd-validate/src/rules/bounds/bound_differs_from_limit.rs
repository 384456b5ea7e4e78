use super::{LEGACY_WIDENING, columns_agree};
use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use crate::tolerance::{number_tolerance, numbers_agree};
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// The bounds of a limited joint are not its limits.
    ///
    /// Planners keep within the bounds. Wider than the limits, they drive the joint into its stops;
    /// narrower, they never use a part of its range.
    ///
    /// Copy `lower` and `upper` of the joint's `limit` (one of the two that is absent is 0). A joint that
    /// others mimic keeps its own limits, and a joint with lower = upper has bounds that are equal. If the
    /// limits have changed in the URDF, write `bounds_module` again.
    BND003 "bound-differs-from-limit", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Passed(DOF005), Passed(BND001)],
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
        for (end, (key, limit, bound)) in [("lower", lower, pair[0]), ("upper", upper, pair[1])]
            .into_iter()
            .enumerate()
        {
            // A locked joint was published with a range; LEG006 reports it.
            let widened = bounds.v1.is_none() && end == 1 && lower == upper;
            let agree = numbers_agree(limit, bound)
                || (widened && numbers_agree(limit + LEGACY_WIDENING, bound));
            if !agree && columns_agree(bounds, dof, end) {
                findings.report(
                    Finding::at(
                        module.file("module.json"),
                        format!("/bounds/{dof}/{end}"),
                        format!(
                            "DOF {dof}: this is not the {key} limit of joint {:?}",
                            joint.name
                        ),
                    )
                    .expected(format!("{limit:?}"))
                    .actual(format!("{bound:?}"))
                    .tolerance(number_tolerance(limit, bound))
                    .off_by(limit - bound, ""),
                );
            }
        }
    }
}
