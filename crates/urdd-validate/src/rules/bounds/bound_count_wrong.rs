use crate::rules::prelude::*;

declare_rule! {
    /// A list of `bounds_module` does not hold one entry per DOF.
    ///
    /// A configuration has `num_dofs` numbers (`dof_module`), and a planner that reads bounds of
    /// another length fails, or worse, bounds the wrong joint. Most often the module is stale: it
    /// was written before the joints or the way in which mimic joints are counted changed.
    ///
    /// Write `bounds_module` again from the same URDF as `dof_module`.
    BND001 "bound-count-wrong", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(DOF003)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let dofs = context.dofs()?.num_dofs;
    let bounds = context.bounds()?;
    let mut lists = vec![
        ("bounds", bounds.bounds.len()),
        ("dof_lower_bounds", bounds.dof_lower_bounds.len()),
        ("dof_upper_bounds", bounds.dof_upper_bounds.len()),
    ];
    if let Some(v1) = document!(context, Bounds) {
        lists.push(("dof_limited", v1.dof_limited.len()));
        lists.push(("dof_velocity_limits", v1.dof_velocity_limits.len()));
        lists.push(("dof_effort_limits", v1.dof_effort_limits.len()));
    }
    let Some(wrong) = wrong_lengths(&lists, dofs.get()) else {
        return Some(());
    };
    let length = wrong.length;
    let message = match wrong.are_all {
        false => format!("one entry per DOF is needed: {}", wrong.in_words),
        true => {
            // Configurations are sampled within the bounds.
            let statistics = context.module(Kind::LinkShapesDistanceStatistics);
            let also = statistics.map_or("", |_| {
                ", and the distance statistics, which are sampled within these bounds, with what is derived from them"
            });
            format!(
                "every list here has {length} entries, but num_dofs of dof_module is {dofs}: the module is stale; write it again from the same robot{also}"
            )
        }
    };
    finding_in(Kind::Bounds, wrong.pointer, message)
        .values(format!("{dofs} entries (num_dofs of dof_module)"), format!("{length} entries"))
        .report(findings);
    Some(())
}
