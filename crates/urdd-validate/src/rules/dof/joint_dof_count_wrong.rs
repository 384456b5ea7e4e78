use crate::rules::prelude::*;

declare_rule! {
    /// A joint has another number of DOFs than its type gives it.
    ///
    /// Revolute, continuous and prismatic joints have one DOF, planar and spherical ones three,
    /// floating ones six, fixed ones none; a mimic joint follows another joint and has none of its
    /// own (in `dof_module` 0.0.1 it has). With a DOF too many or too few, every configuration has
    /// the wrong length.
    ///
    /// Correct `joint_idx_to_dof_idxs_mapping`, and with it everything that is indexed by DOF. If the
    /// joint's type or mimic has changed in `urdf_module`, write `dof_module` and what depends on it
    /// again.
    DOF004 "joint-dof-count-wrong", Error, clause "6.2.2", since "0.1.0",
    phase References, needs [Passed(URD009), Passed(DOF002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let robot = context.robot()?;
    let layout = context.dof_layout()?;
    let dofs = context.dofs()?;
    let joints = robot.joints.iter().zip(&layout.dofs_of_joint);
    for (index, ((joint, right), list)) in
        joints.zip(&dofs.joint_idx_to_dof_idxs_mapping).enumerate()
    {
        if list.len() == right.len() {
            continue;
        }
        let kind = match &joint.mimic {
            Some(mimic) if right.is_empty() => format!("a mimic of {:?}", mimic.joint),
            _ => format!("a {} joint", joint.joint_type),
        };
        let (name, right) = (&joint.name, count(right.len()));
        let pointer = format!("/joint_idx_to_dof_idxs_mapping/{index}");
        let message = format!("joint {index} ({name:?}) is {kind} and has {right} of its own");
        finding_in(Kind::Dof, pointer, message).values(right, count(list.len())).report(findings);
    }
    Some(())
}

fn count(dofs: usize) -> String {
    match dofs {
        0 => "no DOF".to_owned(),
        1 => "1 DOF".to_owned(),
        _ => format!("{dofs} DOFs"),
    }
}
