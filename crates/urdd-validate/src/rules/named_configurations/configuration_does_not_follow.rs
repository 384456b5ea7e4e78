use super::positions::indices;
use crate::rules::prelude::*;

declare_rule! {
    /// The values of a named configuration are not those that follow from its positions.
    ///
    /// Programs move the robot to `configuration`; people read and edit `positions`. Where the two differ, the robot goes
    /// elsewhere than the file seems to say. Most often `positions` was edited by hand and `configuration` was not.
    ///
    /// Write each DOF's position, and for a DOF without one its value in the default configuration: 0, or the bound nearest
    /// to 0. `urdd generate` into the same folder does that.
    CNF004 "configuration-does-not-follow", Error, clause "6.7.5", since "1.0.0",
    phase References,
    needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), ModuleV1(Kind::Bounds), Passed(CNF002),
        Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND006),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let dof = document!(context, Dof)?;
    let bounds = &document!(context, Bounds)?.bounds;
    let known = indices(dof);
    // The bounds of a rotation vector contain 0.
    let default = bounds.iter().map(|[a, b]| 0.0_f64.clamp(a.min(*b), a.max(*b)));
    let default: Vec<f64> = default.collect();
    for (place, configuration) in named.configurations.iter().enumerate() {
        let found = &configuration.configuration;
        let at = format!("/configurations/{place}/configuration");
        if found.len() != default.len() {
            finding_in(Kind::NamedConfigurations, at, "`configuration` needs one value per DOF")
                .counts(default.len(), found.len(), "values")
                .report(findings);
            continue;
        }
        let mut expected: Vec<(f64, bool)> = default.iter().map(|q| (*q, false)).collect();
        for set in &configuration.positions {
            let idx = *known.get(set.dof_name.as_str())?;
            *expected.get_mut(idx)? = (set.position, true);
        }
        for (idx, ((expected, is_set), found)) in expected.into_iter().zip(found).enumerate() {
            let [lower, upper] = *bounds.get(idx)?;
            let size = lower.abs().max(upper.abs());
            let tolerance = number_tolerance(expected, *found).max(NUMBER_RELATIVE * size);
            if (expected - found).abs() <= tolerance {
                continue;
            }
            let name = &dof.dofs.get(idx)?.name;
            let message = match is_set {
                true => format!("`positions` sets the DOF `{name}` to another value"),
                false => format!(
                    "`positions` does not set the DOF `{name}`, and its default value is another"
                ),
            };
            finding_in(Kind::NamedConfigurations, format!("{at}/{idx}"), message)
                .values(expected, found)
                .tolerance(tolerance)
                .report(findings);
        }
    }
    Some(())
}
