use super::dofs::{DofIndices, indices};
use crate::rules::prelude::*;
use urdd_format::dof::DofModule;
use urdd_format::nearest::nearest;

declare_rule! {
    /// A named configuration sets a DOF that the robot lacks, sets one twice, or lists them out of order.
    ///
    /// A program that sets the joints by name finds no such DOF, or takes one of two positions. Most often the joint
    /// was renamed in the URDF.
    ///
    /// Write the DOF's name as `dof_module` has it, each DOF once and in the order of that module.
    CNF002 "configuration-positions-wrong", Error, clause "6.7.3", since "1.0.0",
    phase References,
    needs [
        ModuleV1(Kind::NamedConfigurations), ModuleV1(Kind::Dof), Passed(DOF001), Passed(DOF005), Passed(DOF006),
    ],
}

fn check(context: &Context, findings: &mut Findings) -> Option<()> {
    let named = document!(context, NamedConfigurations)?;
    let dof = document!(context, Dof)?;
    let known = indices(dof);
    for (place, configuration) in named.configurations.iter().enumerate() {
        let mut set = Vec::new();
        for (entry, position) in configuration.positions.iter().enumerate() {
            let name = position.dof_name.as_str();
            let Some((message, expected)) = fault(name, &known, &mut set, dof) else {
                continue;
            };
            let pointer = format!("/configurations/{place}/positions/{entry}/dof_name");
            finding_in(Kind::NamedConfigurations, pointer, message)
                .values(expected, format!("`{name}`"))
                .report(findings);
        }
    }
    Some(())
}

/// What is wrong with the name of a DOF after those that are `set`, and what to write.
fn fault(
    name: &str,
    known: &DofIndices,
    set: &mut Vec<usize>,
    dof: &DofModule,
) -> Option<(&'static str, String)> {
    let Some(&idx) = known.get(name) else {
        let near = nearest(dof.dofs.iter().map(|dof| dof.name.as_str()), name);
        let expected = match near {
            Some(near) => format!("a DOF of dof_module, such as `{near}`"),
            None => "a DOF of dof_module".to_owned(),
        };
        return Some(("the robot has no such DOF", expected));
    };
    if set.last().is_none_or(|last| *last < idx) {
        set.push(idx);
        return None;
    }
    let message = match set.binary_search(&idx) {
        Ok(_) => "this DOF is set twice",
        Err(_) => "the positions are not in the order of the DOFs",
    };
    let expected = "each DOF at most once, in the order of dof_module";
    Some((message, expected.to_owned()))
}
