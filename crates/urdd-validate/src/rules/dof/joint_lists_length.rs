use crate::rules::prelude::*;

declare_rule! {
    /// A list of `dof_module` that is indexed by joint does not hold one entry per joint.
    ///
    /// Programs look up `joint_idx_to_dof_idxs_mapping[joint]` and `joint_idx_to_mimic_mapping[joint]`
    /// with the joint indices of `urdf_module`. With too few or too many entries, every joint after
    /// the gap moves with the wrong DOF.
    ///
    /// Write one entry for every joint, in joint order: fixed joints have the entries `[]` and null.
    /// If `urdf_module` has changed since, write `dof_module` again.
    DOF002 "joint-lists-length", Error, clause "6.2.1", since "0.1.0",
    phase References, needs [Module(Kind::Dof), ROBOT_SOUND],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let joints = context.robot()?.joints.len();
    let dofs = context.dofs()?;
    let mut lists =
        vec![("joint_idx_to_dof_idxs_mapping", dofs.joint_idx_to_dof_idxs_mapping.len())];
    if let Some(v1) = document!(context, Dof) {
        let mimics = v1.joint_idx_to_mimic_mapping.len();
        lists.push(("joint_idx_to_mimic_mapping", mimics));
    }
    if let Some(wrong) = wrong_lengths(&lists, joints) {
        let all = wrong.in_words;
        let message = format!("one entry per joint of urdf_module is needed: {all}");
        finding_in(Kind::Dof, wrong.pointer, message)
            .counts(joints, wrong.length, "entries")
            .report(findings);
    }
    Some(())
}
