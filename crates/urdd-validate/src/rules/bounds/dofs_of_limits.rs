use super::unlimited::{LEGACY_WIDENING, columns_agree, dofs, limited_dofs};
use crate::rules::prelude::*;

declare_rule! {
    /// The bounds of a limited joint are not its limits.
    ///
    /// Planners keep within the bounds. Wider than the limits, they drive the joint into its stops;
    /// narrower, they never use a part of its range.
    ///
    /// Copy `lower` and `upper` of the joint's `limit` (one of the two that is absent is 0). A joint that
    /// others mimic keeps its own limits, and a joint with lower = upper has bounds that are equal. If the
    /// limits have changed in the URDF, write `bounds_module` again.
    BND003 "bound-differs-from-limit", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Passed(DOF005), Passed(BND001)], check bound_differs_from_limit,

    /// `dof_limited` does not say which DOFs the robot's source limits.
    ///
    /// A DOF that is not limited has bounds too, only so that it can be sampled. A program that takes them
    /// for limits will not turn a continuous joint past half a turn; one that takes limits for such bounds
    /// drives a joint into its stops.
    ///
    /// Write true for DOFs of revolute and prismatic joints whose `limit` has `lower` or `upper`, and false
    /// for all others, those of continuous joints included.
    BND004 "limited-flag-wrong", Error, clause "6.5.2", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001), ModuleV1(Kind::Bounds)],
    check limited_flag_wrong,

    /// The velocity or effort limit of a DOF is not the joint's.
    ///
    /// Trajectories are timed by these numbers: too high a limit asks of a motor what it cannot give, and 0
    /// where the URDF says nothing stops the joint for good.
    ///
    /// Copy `velocity` and `effort` of the `limit` of joints of one DOF. Write null where the URDF has none,
    /// and for the DOFs of planar, floating and spherical joints.
    BND005 "speed-or-effort-differs", Error, clause "6.5.4", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001), ModuleV1(Kind::Bounds)],
    check speed_or_effort_differs,
}

fn bound_differs_from_limit(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = context.bounds()?;
    for limited in limited_dofs(context)? {
        let (dof, [lower, upper]) = (limited.dof, limited.limits);
        for (end, key) in ["lower", "upper"].into_iter().enumerate() {
            let (limit, bound) = (limited.limits[end], limited.bounds[end]);
            // Legacy modules give a locked joint a range; LEG006 reports it.
            let widened = context.is_legacy(Kind::Bounds) && end == 1 && lower == upper;
            let agree = numbers_agree(limit, bound)
                || (widened && numbers_agree(limit + LEGACY_WIDENING, bound));
            if !agree && columns_agree(bounds, dof, end) {
                let name = &limited.joint.name;
                let message = format!("DOF {dof}: this is not the {key} limit of joint {name:?}");
                finding_in(Kind::Bounds, format!("/bounds/{dof}/{end}"), message)
                    .numbers(limit, bound, number_tolerance(limit, bound))
                    .report(findings);
            }
        }
    }
    Some(())
}

fn limited_flag_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = document!(context, Bounds)?;
    for (written, (dof, joint)) in bounds.dof_limited.iter().zip(dofs(context)?) {
        let limited = joint.position_limits().is_some();
        if *written != limited {
            let why = match limited {
                true => "has limits in urdf_module".to_owned(),
                false => format!("is a {} joint without position limits", joint.joint_type),
            };
            let message = format!("DOF {dof} moves joint {:?}, which {why}", joint.name);
            finding_in(Kind::Bounds, format!("/dof_limited/{dof}"), message)
                .values(limited, written)
                .report(findings);
        }
    }
    Some(())
}

fn speed_or_effort_differs(context: &Context, findings: &mut Findings) -> Option<()> {
    let bounds = document!(context, Bounds)?;
    let lists = bounds.dof_velocity_limits.iter().zip(&bounds.dof_effort_limits);
    for ((dof, joint), (speed, effort)) in dofs(context)?.zip(lists) {
        let limit = joint.limit.filter(|_| joint.num_dofs() == 1);
        let right_speed = limit.and_then(|limit| limit.velocity);
        let right_effort = limit.and_then(|limit| limit.effort);
        for (key, right, written) in [
            ("dof_velocity_limits", right_speed, *speed),
            ("dof_effort_limits", right_effort, *effort),
        ] {
            let both = right.zip(written);
            if both.map_or(right == written, |(a, b)| numbers_agree(a, b)) {
                continue;
            }
            let message = format!(
                "this is not what urdf_module says of joint {:?}, which DOF {dof} moves",
                joint.name
            );
            let finding = finding_in(Kind::Bounds, format!("/{key}/{dof}"), message);
            findings.report(match both {
                Some((right, written)) => {
                    finding.numbers(right, written, number_tolerance(right, written))
                }
                None => finding.values(or_null(right), or_null(written)),
            });
        }
    }
    Some(())
}
