use super::dofs;
use crate::rules::prelude::*;

declare_rule! {
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
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
