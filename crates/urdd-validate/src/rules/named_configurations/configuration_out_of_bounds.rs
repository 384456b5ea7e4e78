use super::dofs::indices;
use crate::rules::prelude::*;

declare_rule! {
    /// A named configuration sets a limited joint beyond its limits.
    ///
    /// A robot that is sent there stops at the limit, or the controller refuses the whole motion. Most often degrees were
    /// written for radians, or the limits of the URDF changed.
    ///
    /// Write a position between the DOF's two bounds in `bounds_module`, rad or m.
    CNF003 "configuration-out-of-bounds", Error, clause "6.7.4", since "1.0.0",
    phase References,
    needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), ModuleV1(Kind::Bounds), Passed(CNF002),
        Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND004),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let bounds = document!(context, Bounds)?;
    let known = indices(document!(context, Dof)?);
    for (place, configuration) in named.configurations.iter().enumerate() {
        for (entry, set) in configuration.positions.iter().enumerate() {
            let idx = *known.get(set.dof_name.as_str())?;
            if !*bounds.dof_limited.get(idx)? {
                continue;
            }
            // An odd robot has its two bounds the other way round (SPEC 6.5.2).
            let &[a, b] = bounds.bounds.get(idx)?;
            let (lower, upper) = (a.min(b), a.max(b));
            let size = lower.abs().max(upper.abs());
            let tolerance = (NUMBER_RELATIVE * size).max(NUMBER_ABSOLUTE);
            let beyond = (lower - set.position).max(set.position - upper);
            if beyond <= tolerance {
                continue;
            }
            let pointer = format!("/configurations/{place}/positions/{entry}/position");
            let message = format!("the limited DOF `{}` cannot be there", set.dof_name);
            finding_in(Kind::NamedConfigurations, pointer, message)
                .values(format!("{lower:?} to {upper:?}"), format!("{:?}", set.position))
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}
