use crate::rules::prelude::*;
use urdd_document::dof_layout::bounds_without_limits;

declare_rule! {
    /// A list of `bounds_module` does not hold one entry per DOF.
    ///
    /// A configuration has `num_dofs` numbers (`dof_module`), and a planner that reads bounds of
    /// another length fails, or worse, bounds the wrong joint. Most often the module is stale: it
    /// was written before the joints or the way in which mimic joints are counted changed.
    ///
    /// Write `bounds_module` again from the same URDF as `dof_module`.
    BND001 "bound-count-wrong", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(DOF003)], check bound_count_wrong,

    /// `dof_lower_bounds` or `dof_upper_bounds` is not the column of `bounds`.
    ///
    /// The module says the same twice, for programs that want pairs and for programs that want two
    /// vectors. Where the two differ, programs disagree about the robot.
    ///
    /// Write all three lists from the limits of the joints (SPEC 6.5.2, and 6.5.3 for DOFs without limits):
    /// these decide which of the two is right, and the finding is at the other.
    BND002 "bounds-columns-differ", Error, clause "6.5.1", since "0.1.0",
    phase References, needs [Module(Kind::Bounds), Passed(BND001)], check bounds_columns_differ,
}

fn bound_count_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
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
    let Some(wrong) = wrong_lengths(&lists, dofs.get()) else { return Some(()) };
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

fn bounds_columns_differ(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = context.bounds()?;
    for (column, (name, values)) in [
        ("dof_lower_bounds", &bounds.dof_lower_bounds),
        ("dof_upper_bounds", &bounds.dof_upper_bounds),
    ]
    .into_iter()
    .enumerate()
    {
        for (dof, (pair, value)) in bounds.bounds.iter().zip(values).enumerate() {
            let paired = pair[column];
            if numbers_agree(paired, *value) {
                continue;
            }
            let (of_pairs, of_list) = (format!("/bounds/{dof}/{column}"), format!("/{name}/{dof}"));
            let decided = decided(context, dof, column);
            let is = |written: f64| {
                let bound = decided.as_ref().map(|(bound, _)| *bound);
                bound.is_some_and(|bound| numbers_agree(bound, written))
            };
            let (wrong, written, right, other) = match is(*value) {
                true => (of_pairs, paired, *value, of_list),
                false => (of_list, *value, paired, of_pairs),
            };
            let (message, expected) = match &decided {
                Some((_, why)) if is(*value) || is(paired) => (
                    format!("DOF {dof}: this is not the value of `{other}`, and {why}"),
                    format!("{right:?}, as `{other}` has it"),
                ),
                Some((bound, why)) => (
                    format!(
                        "DOF {dof}: this is not the value of `{other}`, and neither is right: {why}"
                    ),
                    format!("{bound:?} in both places"),
                ),
                None => (
                    format!("DOF {dof}: this is not the value of `{other}`; one of them is wrong"),
                    format!("{right:?}, as `{other}` has it"),
                ),
            };
            finding_in(Kind::Bounds, wrong, message)
                .values(expected, format!("{written:?}"))
                .tolerance(number_tolerance(right, written))
                .off_by(right - written, "")
                .report(findings);
        }
    }
    Some(())
}

/// The right bound and why it is, if the robot and `dof_module` agree on the joint of the DOF. `None` in legacy modules, which may
/// have other bounds.
fn decided(context: &Context, dof: usize, end: usize) -> Option<(f64, String)> {
    document!(context, Bounds)?;
    let (joint, place) = context.dof_layout()?.place(dof)?;
    let stated = context.dofs()?.dof_idx_to_joint_idx_mapping.get(dof)?.get();
    if stated != joint {
        return None;
    }
    let joint = context.robot()?.joints.get(joint)?;
    let side = ["lower", "upper"][end];
    let (bounds, what, without) = match joint.position_limits() {
        Some((lower, upper)) => ([lower, upper], "limit", ""),
        None => {
            (bounds_without_limits(joint.joint_type, place)?, "bound", ", which has no limits,")
        }
    };
    let (bound, name) = (bounds[end], &joint.name);
    Some((bound, format!("the {side} {what} of joint `{name}`{without} is {bound:?}")))
}
