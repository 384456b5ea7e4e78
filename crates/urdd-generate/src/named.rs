//! Named configurations that a person decided on, for the robot that is made.

use urdd_format::bounds::BoundsModule;
use urdd_format::dof::DofModule;
use urdd_format::named_configurations::{
    ConfigurationEdit, NamedConfiguration, NamedDofs, PositionFault,
};

/// The user's named configurations, for this robot.
#[derive(Debug, Clone, Default)]
pub(crate) struct Named {
    pub configurations: Vec<NamedConfiguration>,
    /// Positions that this robot cannot have: the configuration, and what is wrong.
    pub lost: Vec<(String, String)>,
}

impl Named {
    /// Leaves out the positions that this robot cannot have.
    pub fn of(edits: &[ConfigurationEdit], dof: &DofModule, bounds: &BoundsModule) -> Self {
        let dofs = NamedDofs::new(dof, bounds);
        let mut named = Named::default();
        for edit in edits {
            let mut kept = edit.clone();
            kept.positions.retain(|position| {
                let (name, dof, at) = (&edit.name, &position.dof_name, position.position);
                let problem = match dofs.fault(position) {
                    None => return true,
                    Some(PositionFault::UnknownDof) => format!(
                        "the configuration `{name}` has a position of the DOF `{dof}`, but the robot has no such DOF"
                    ),
                    Some(PositionFault::OutOfBounds([lower, upper])) => format!(
                        "the configuration `{name}` has the DOF `{dof}` at {at}, but its bounds are {lower} and {upper}"
                    ),
                };
                named.lost.push((name.to_string(), problem));
                false
            });
            named.configurations.push(dofs.named(&kept));
        }
        named
    }
}
