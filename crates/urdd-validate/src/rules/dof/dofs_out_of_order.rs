use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

declare_rule! {
    /// DOFs do not stand in joint order.
    ///
    /// The order of a configuration is part of the format: DOFs in the order of their joints, and
    /// those of one joint in the order that SPEC gives for its type. Stored configurations, bounds
    /// and samples of another order are silently those of another robot.
    ///
    /// Number the DOFs anew, going through the joints in joint order, and bring everything that is
    /// indexed by DOF in the same order.
    DOF005 "dofs-out-of-order", Error, clause "6.2.4", since "0.1.0",
    phase References, needs [Passed(DOF003)],
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(dofs), Some(module)) = (context.dofs(), context.module(ModuleKind::Dof)) else {
        return;
    };
    let file = module.file("module.json");
    for (dof, pair) in dofs.joint_of_dof.windows(2).enumerate() {
        if let [before, after] = pair
            && after < before
        {
            let dof = dof + 1;
            findings.report(
                Finding::at(
                    &file,
                    format!("/dof_idx_to_joint_idx_mapping/{dof}"),
                    format!(
                        "DOF {dof} moves joint {after}, but the DOF before it moves joint {before}: number the DOFs in joint order"
                    ),
                )
                .expected(format!("joint {before} or later"))
                .actual(format!("joint {after}")),
            );
        }
    }
    // DOFs of different joints that were swapped stand wrongly in these lists too.
    if !findings.is_empty() {
        return;
    }
    for (joint, list) in dofs.dofs_of_joint.iter().enumerate() {
        if !list.is_sorted() {
            let mut right = list.clone();
            right.sort_unstable();
            let text = |list: &[_]| {
                format!(
                    "{:?}",
                    list.iter()
                        .map(|d: &urdd_format::index::DofIdx| d.get())
                        .collect::<Vec<_>>()
                )
            };
            findings.report(
                Finding::at(
                    &file,
                    format!("/joint_idx_to_dof_idxs_mapping/{joint}"),
                    format!("the DOFs of joint {joint} do not ascend"),
                )
                .expected(text(&right))
                .actual(text(list)),
            );
        }
    }
}
