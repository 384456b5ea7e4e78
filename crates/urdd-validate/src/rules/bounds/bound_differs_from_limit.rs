use super::{LEGACY_WIDENING, columns_agree, limited_dofs};
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
    phase References, needs [Passed(DOF005), Passed(BND001)],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
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
