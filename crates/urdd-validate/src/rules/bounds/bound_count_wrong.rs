use crate::context::Context;
use crate::finding::{Finding, Findings};
use crate::rule::declare_rule;
use urdd_format::registry::ModuleKind;

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
    check check,
}

fn check(context: &Context, findings: &mut Findings) {
    let (Some(dofs), Some(bounds), Some(module)) = (
        context.dofs(),
        context.bounds(),
        context.module(ModuleKind::Bounds),
    ) else {
        return;
    };
    let mut lists = vec![
        ("bounds", bounds.bounds.len()),
        ("dof_lower_bounds", bounds.lower.len()),
        ("dof_upper_bounds", bounds.upper.len()),
    ];
    if let Some(v1) = bounds.v1 {
        lists.push(("dof_limited", v1.dof_limited.len()));
        lists.push(("dof_velocity_limits", v1.dof_velocity_limits.len()));
        lists.push(("dof_effort_limits", v1.dof_effort_limits.len()));
    }
    let wrong: Vec<&(&str, usize)> = lists
        .iter()
        .filter(|(_, length)| *length != dofs.num_dofs.get())
        .collect();
    let Some((first, length)) = wrong.first() else {
        return;
    };
    // A stale module is one mistake, though it shows in every list.
    let message = if wrong.len() == lists.len() {
        // Configurations are sampled within the bounds.
        let also = match context.module(ModuleKind::LinkShapesDistanceStatistics) {
            Some(_) => {
                ", and the distance statistics, which are sampled within these bounds, with what is derived from them"
            }
            None => "",
        };
        format!(
            "every list here has {length} entries, but num_dofs of dof_module is {}: the module is stale; write it again from the same robot{also}",
            dofs.num_dofs
        )
    } else {
        let names: Vec<String> = wrong
            .iter()
            .map(|(name, length)| format!("`{name}` has {length}"))
            .collect();
        format!("one entry per DOF is needed: {}", names.join(", "))
    };
    findings.report(
        Finding::at(module.file("module.json"), format!("/{first}"), message)
            .expected(format!(
                "{} entries (num_dofs of dof_module)",
                dofs.num_dofs
            ))
            .actual(format!("{length} entries")),
    );
}
