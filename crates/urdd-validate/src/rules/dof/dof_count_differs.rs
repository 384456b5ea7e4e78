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
    phase References, needs [Module(Kind::Dof)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
