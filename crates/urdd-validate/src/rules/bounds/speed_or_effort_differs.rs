use super::dofs;
use crate::rules::prelude::*;

declare_rule! {
    /// The velocity or effort limit of a DOF is not the joint's.
    ///
    /// Trajectories are timed by these numbers: too high a limit asks of a motor what it cannot give, and 0
    /// where the URDF says nothing stops the joint for good.
    ///
    /// Copy `velocity` and `effort` of the `limit` of joints of one DOF. Write null where the URDF has none,
    /// and for the DOFs of planar, floating and spherical joints.
    BND005 "speed-or-effort-differs", Error, clause "6.5.4", since "0.1.0",
    phase References, needs [Version1, Passed(DOF005), Passed(BND001), ModuleV1(Kind::Bounds)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
