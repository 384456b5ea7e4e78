use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(robot), Some(dofs), Some(module)) = (
        context.robot(),
        context.dofs(),
        context.module(ModuleKind::Dof),
    ) else {
        return;
    };
    let joints = robot.joints.len();
    let mut lists = vec![("joint_idx_to_dof_idxs_mapping", dofs.dofs_of_joint.len())];
    if let Some(v1) = dofs.v1 {
        lists.push((
            "joint_idx_to_mimic_mapping",
            v1.joint_idx_to_mimic_mapping.len(),
        ));
    }
    let wrong: Vec<&(&str, usize)> = lists
        .iter()
        .filter(|(_, length)| *length != joints)
        .collect();
    let Some((first, length)) = wrong.first() else {
        return;
    };
    let names: Vec<String> = wrong
        .iter()
        .map(|(name, length)| format!("`{name}` has {length}"))
        .collect();
    findings.report(
        Finding::at(
            module.file("module.json"),
            format!("/{first}"),
            format!(
                "one entry per joint of urdf_module is needed: {}",
                names.join(", ")
            ),
        )
        .expected(format!("{joints} entries"))
        .actual(format!("{length} entries")),
    );
}
