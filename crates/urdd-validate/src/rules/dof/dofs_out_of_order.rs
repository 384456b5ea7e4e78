use crate::rules::prelude::*;

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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?;
    let joints = dofs.dof_idx_to_joint_idx_mapping.iter();
    for (dof, (before, after)) in (1..).zip(joints.clone().zip(joints.skip(1))) {
        if after < before {
            let pointer = format!("/dof_idx_to_joint_idx_mapping/{dof}");
            let message = format!(
                "DOF {dof} moves joint {after}, but the DOF before it moves joint {before}: number the DOFs in joint order"
            );
            finding_in(Kind::Dof, pointer, message)
                .values(format!("joint {before} or later"), format!("joint {after}"))
                .report(findings);
        }
    }
    // Swapped DOFs of different joints are wrong in these lists too.
    if !findings.is_empty() {
        return Some(());
    }
    for (joint, list) in dofs.joint_idx_to_dof_idxs_mapping.iter().enumerate() {
        if !list.is_sorted() {
            let written: Vec<usize> = list.iter().map(|dof| dof.get()).collect();
            let mut right = written.clone();
            right.sort_unstable();
            let pointer = format!("/joint_idx_to_dof_idxs_mapping/{joint}");
            let message = format!("the DOFs of joint {joint} are not in ascending order");
            finding_in(Kind::Dof, pointer, message).literals(&right, &written).report(findings);
        }
    }
    Some(())
}
