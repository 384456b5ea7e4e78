use crate::rules::bounds::limits::{LEGACY_WIDENING, limited_dofs};
use crate::rules::prelude::*;

declare_rule! {
    /// The upper bound of a joint whose two limits are equal was raised by 1e-7.
    ///
    /// Published modules never have equal bounds. The joint stays locked for every purpose, but a program
    /// that looks for lower = upper does not see it. (Where published modules could not distinguish absent limits
    /// from zeros, the joint may also have no limits and be frozen by mistake: look into its URDF.)
    ///
    /// Nothing needs to be done. From version 1 on, a locked joint has equal bounds.
    LEG006 "locked-bound-widened", Info, clause "10.3", since "0.1.0",
    phase References, needs [Legacy, Passed(DOF005), Passed(BND002)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    for limited in limited_dofs(context)? {
        let ([lower, upper], [_, written]) = (limited.limits, limited.bounds);
        let raised = upper + LEGACY_WIDENING;
        if lower == upper && !numbers_agree(upper, written) && numbers_agree(raised, written) {
            let message = format!(
                "joint {:?} is locked at {upper:?}; its upper bound was raised by {LEGACY_WIDENING:?}",
                limited.joint.name
            );
            finding_in(Kind::Bounds, format!("/bounds/{}/1", limited.dof), message)
                .literals(upper, written)
                .report(findings);
        }
    }
    Some(())
}
