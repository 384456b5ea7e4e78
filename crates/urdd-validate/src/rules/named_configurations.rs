//! CNF: `named_configurations_module`.

use std::collections::HashMap;

use crate::rules::prelude::*;
use crate::rules::urdf::tree::repeated;
use urdd_format::dof::DofModule;
use urdd_format::nearest::nearest;

declare_rule! {
    /// Two named configurations have the same name.
    ///
    /// A program that asks for `home` moves the robot to one of the two, and another program to the other.
    ///
    /// Rename one of them, or remove it: `urdd configurations remove` and `urdd configurations set`.
    CNF001 "configuration-name-repeated", Error, clause "6.7.2", since "1.0.0",
    phase References, needs [ModuleV1(Kind::NamedConfigurations)], check configuration_name_repeated,

    /// A named configuration sets a DOF that the robot lacks, sets one twice, or lists them out of order.
    ///
    /// A program that sets the joints by name finds no such DOF, or takes one of two positions. Most often the joint
    /// was renamed in the URDF.
    ///
    /// Write the DOF's name as `dof_module` has it, each DOF once and in the order of that module.
    CNF002 "configuration-positions-wrong", Error, clause "6.7.3", since "1.0.0",
    phase References, needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), Passed(DOF001), Passed(DOF005), Passed(DOF006),
    ], check configuration_positions_wrong,

    /// A named configuration sets a limited joint beyond its limits.
    ///
    /// A robot that is sent there stops at the limit, or the controller refuses the whole motion. Most often degrees were
    /// written for radians, or the limits of the URDF changed.
    ///
    /// Write a position between the DOF's two bounds in `bounds_module`, rad or m.
    CNF003 "configuration-out-of-bounds", Error, clause "6.7.4", since "1.0.0",
    phase References, needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), ModuleV1(Kind::Bounds), Passed(CNF002),
        Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND004),
    ], check configuration_out_of_bounds,

    /// The values of a named configuration are not those that follow from its positions.
    ///
    /// Programs move the robot to `configuration`; people read and edit `positions`. Where the two differ, the robot goes
    /// elsewhere than the file seems to say. Most often `positions` was edited by hand and `configuration` was not.
    ///
    /// Write each DOF's position, and for a DOF without one its value in the default configuration: 0, or the bound nearest
    /// to 0. `urdd generate` into the same folder does that.
    CNF004 "configuration-does-not-follow", Error, clause "6.7.5", since "1.0.0",
    phase References, needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), ModuleV1(Kind::Bounds), Passed(CNF002),
        Passed(BND001), Passed(BND002), Passed(BND003), Passed(BND006),
    ], check configuration_does_not_follow,
}

fn configuration_name_repeated(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let names = named.configurations.iter().map(|one| one.name.as_str());
    for (index, first, name) in repeated(names) {
        let pointer = format!("/configurations/{index}/name");
        finding_in(Kind::NamedConfigurations, pointer, "another configuration has this name")
            .values("each name once", format!("`{name}`, as configuration {first}"))
            .report(findings);
    }
    Some(())
}

fn configuration_positions_wrong(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let dof = document!(context, Dof)?;
    let known = indices(dof);
    for (place, configuration) in named.configurations.iter().enumerate() {
        let mut set = Vec::new();
        for (entry, position) in configuration.positions.iter().enumerate() {
            let name = position.dof_name.as_str();
            let (message, expected) = match known.get(name) {
                None => {
                    let near = nearest(dof.dofs.iter().map(|dof| dof.name.as_str()), name);
                    let such = near.map_or(String::new(), |near| format!(", such as `{near}`"));
                    ("the robot has no such DOF", format!("a DOF of dof_module{such}"))
                }
                Some(idx) if set.last().is_none_or(|last| last < idx) => {
                    set.push(*idx);
                    continue;
                }
                Some(idx) => {
                    let message = match set.binary_search(idx) {
                        Ok(_) => "this DOF is set twice",
                        Err(_) => "the positions are not in the order of the DOFs",
                    };
                    (message, "each DOF at most once, in the order of dof_module".to_owned())
                }
            };
            let pointer = format!("/configurations/{place}/positions/{entry}/dof_name");
            finding_in(Kind::NamedConfigurations, pointer, message)
                .values(expected, format!("`{name}`"))
                .report(findings);
        }
    }
    Some(())
}

fn configuration_out_of_bounds(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let bounds = document!(context, Bounds)?;
    let known = indices(document!(context, Dof)?);
    for (place, configuration) in named.configurations.iter().enumerate() {
        for (entry, set) in configuration.positions.iter().enumerate() {
            let idx = *known.get(set.dof_name.as_str())?;
            if !*bounds.dof_limited.get(idx)? {
                continue;
            }
            let bounds = bounds.bounds.get(idx)?;
            report_beyond_bounds(*bounds, set.position, findings, || {
                let pointer = format!("/configurations/{place}/positions/{entry}/position");
                let message = format!("the limited DOF `{}` cannot be there", set.dof_name);
                finding_in(Kind::NamedConfigurations, pointer, message)
            });
        }
    }
    Some(())
}

/// The index of each DOF by name; of several DOFs with one name, of the first.
fn indices(dof: &DofModule) -> HashMap<&str, usize> {
    let dofs = dof.dofs.iter().enumerate().rev();
    dofs.map(|(idx, dof)| (dof.name.as_str(), idx)).collect()
}

fn configuration_does_not_follow(context: &Context, findings: &mut Findings) -> Option<()> {
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
            let name = &dof.dofs.get(idx)?.name;
            report_off_by_bounds(*bounds.get(idx)?, [expected, *found], findings, || {
                let message = match is_set {
                    true => format!("`positions` sets the DOF `{name}` to another value"),
                    false => format!(
                        "`positions` does not set the DOF `{name}`, and its default value is another"
                    ),
                };
                finding_in(Kind::NamedConfigurations, format!("{at}/{idx}"), message)
            });
        }
    }
    Some(())
}
