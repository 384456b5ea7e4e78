use crate::rules::prelude::*;

declare_rule! {
    /// `dof_idx_to_joint_idx_mapping` and `joint_idx_to_dof_idxs_mapping` are not each other's inverse.
    ///
    /// One says which joint a DOF moves, the other which DOFs a joint has. Where they disagree, a
    /// program that goes from joints to DOFs and one that goes from DOFs to joints move different
    /// joints with the same configuration.
    ///
    /// Write one of the two from the other. The findings are where a mapping differs from what follows
    /// from `urdf_module`: DOFs in joint order.
    DOF003 "dof-mappings-disagree", Error, clause "6.2.3", since "0.1.0",
    phase References, needs [Passed(DOF001), Passed(DOF004)], check dof_mappings_disagree,

    /// DOFs do not stand in joint order.
    ///
    /// The order of a configuration is part of the format: DOFs in the order of their joints, and
    /// those of one joint in the order that SPEC gives for its type. Stored configurations, bounds
    /// and samples of another order are silently those of another robot.
    ///
    /// Number the DOFs anew, going through the joints in joint order, and bring everything that is
    /// indexed by DOF in the same order.
    DOF005 "dofs-out-of-order", Error, clause "6.2.4", since "0.1.0",
    phase References, needs [Passed(DOF003)], check dofs_out_of_order,
}

fn dof_mappings_disagree(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = context.dofs()?;
    let joint_of_dof: Vec<usize> =
        dofs.dof_idx_to_joint_idx_mapping.iter().map(|joint| joint.get()).collect();
    let dofs_of_joint =
        dofs.joint_idx_to_dof_idxs_mapping.iter().map(|list| list.iter().map(|dof| dof.get()));
    if are_inverse(&joint_of_dof, dofs_of_joint.clone()) {
        return Some(());
    }
    let name = |joint: usize| match robot.joints.get(joint) {
        Some(joint) => format!("{:?}", joint.name),
        None => "no joint".to_owned(),
    };
    for ((joint, list), right) in dofs_of_joint.enumerate().zip(&layout.dofs_of_joint) {
        for ((place, dof), right) in list.enumerate().zip(right.clone()) {
            if dof != right {
                let pointer = format!("/joint_idx_to_dof_idxs_mapping/{joint}/{place}");
                let message = format!(
                    "the mappings disagree: joint {joint} ({}) is said to have DOF {dof}",
                    name(joint)
                );
                finding_in(Kind::Dof, pointer, message).values(right, dof).report(findings);
            }
        }
    }
    let all = layout.joint_of_dof.len();
    for (dof, joint) in joint_of_dof.iter().copied().enumerate() {
        let right = layout.joint_of_dof.get(dof).copied();
        if right != Some(joint) {
            let pointer = format!("/dof_idx_to_joint_idx_mapping/{dof}");
            let message = format!(
                "the mappings disagree: DOF {dof} is said to move joint {joint} ({})",
                name(joint)
            );
            let right = right.map_or(format!("{all} DOFs in all"), |right| right.to_string());
            finding_in(Kind::Dof, pointer, message).values(right, joint).report(findings);
        }
    }
    if findings.is_empty() {
        let message = "joints have DOFs that are not listed here; list every DOF";
        finding_in(Kind::Dof, "/dof_idx_to_joint_idx_mapping", message)
            .counts(all, joint_of_dof.len(), "entries")
            .report(findings);
    }
    Some(())
}

/// Whether every DOF is listed exactly once, by the joint that it moves.
pub fn are_inverse(
    joint_of_dof: &[usize],
    dofs_of_joint: impl Iterator<Item = impl Iterator<Item = usize>>,
) -> bool {
    let mut listed = vec![false; joint_of_dof.len()];
    for (joint, list) in dofs_of_joint.enumerate() {
        for dof in list {
            match (joint_of_dof.get(dof), listed.get_mut(dof)) {
                (Some(moved), Some(listed)) if *moved == joint && !*listed => *listed = true,
                _ => return false,
            }
        }
    }
    listed.into_iter().all(|listed| listed)
}

fn dofs_out_of_order(context: &Context, findings: &mut Findings) -> Option<()> {
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
