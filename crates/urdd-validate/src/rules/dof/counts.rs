use crate::rules::prelude::*;

declare_rule! {
    /// `num_dofs` and the lists that hold one entry per DOF do not agree on the number of DOFs.
    ///
    /// `num_dofs` is the length of a configuration. Programs allocate by it and index the lists with
    /// it: where one of them has another length, they crash, or read the wrong joint.
    ///
    /// Make `num_dofs`, the length of `dof_idx_to_joint_idx_mapping` and (from version 1 on) the
    /// length of `dofs` equal. Most often one of them was edited by hand, or was written before
    /// mimic joints were left out.
    DOF001 "dof-count-differs", Error, clause "6.2.1", since "0.1.0",
    phase References, needs [Module(Kind::Dof)], check dof_count_differs,

    /// A list of `dof_module` that is indexed by joint does not hold one entry per joint.
    ///
    /// Programs look up `joint_idx_to_dof_idxs_mapping[joint]` and `joint_idx_to_mimic_mapping[joint]`
    /// with the joint indices of `urdf_module`. With too few or too many entries, every joint after
    /// the gap moves with the wrong DOF.
    ///
    /// Write one entry for every joint, in joint order: fixed joints have the entries `[]` and null.
    /// If `urdf_module` has changed since, write `dof_module` again.
    DOF002 "joint-lists-length", Error, clause "6.2.1", since "0.1.0",
    phase References, needs [Module(Kind::Dof), ROBOT_SOUND], check joint_lists_length,

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
    phase References, needs [Passed(URD009), Passed(DOF002)], check joint_dof_count_wrong,
}

fn dof_count_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?;
    let mut counts = vec![
        ("num_dofs", dofs.num_dofs.get()),
        ("dof_idx_to_joint_idx_mapping", dofs.dof_idx_to_joint_idx_mapping.len()),
    ];
    if let Some(v1) = document!(context, Dof) {
        counts.push(("dofs", v1.dofs.len()));
    }
    if let Some((name, count, others)) = odd_one(&counts) {
        let all = counts.iter().map(|(name, count)| format!("`{name}` {count}"));
        let message = format!(
            "the number of DOFs differs from place to place: {}; make them agree",
            all.collect::<Vec<_>>().join(", ")
        );
        finding_in(Kind::Dof, format!("/{name}"), message)
            .values(format!("{others} DOFs"), format!("{count} DOFs"))
            .report(findings);
    }
    Some(())
}

/// The name and value of the count that differs from the others (the first if no two agree), and the others' value.
/// `None` if all agree.
pub fn odd_one<'a>(counts: &[(&'a str, usize)]) -> Option<(&'a str, usize, usize)> {
    let first = counts.first()?;
    if counts.iter().all(|(_, count)| *count == first.1) {
        return None;
    }
    let alone = |candidate: &(&str, usize)| {
        let mut others = counts.iter().filter(|(name, _)| *name != candidate.0);
        let count = others.next().map(|(_, count)| *count)?;
        (count != candidate.1 && others.all(|(_, other)| *other == count)).then_some(count)
    };
    counts
        .iter()
        .find_map(|candidate| Some((candidate.0, candidate.1, alone(candidate)?)))
        .or_else(|| Some((first.0, first.1, counts.get(1)?.1)))
}

fn joint_lists_length(context: &Context, findings: &mut Findings) -> Option<()> {
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

fn joint_dof_count_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
