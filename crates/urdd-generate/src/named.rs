//! Named configurations that a person decided on, for the robot that is made, and the reference configuration: one of
//! them that takes the place of the default configuration where pairs of links that touch are skipped. SPEC 8.6 knows the
//! default configuration alone, so edits of skips say the rest.

use super::donor::edits::Decisions;
use super::error::ReferenceFault;
use urdd_format::bounds::BoundsModule;
use urdd_format::dof::DofModule;
use urdd_format::link_shapes_skips::SkippedReason;
use urdd_format::named_configurations::{
    ConfigurationEdit, NamedConfiguration, NamedDofs, PositionFault,
};
use urdd_format::short::Short;

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

/// The word for the default configuration, where no configuration has this name.
const DEFAULT: &str = "default";

/// The configuration of this name; `None` for the default configuration, or where none is asked for.
pub(super) fn reference(
    name: Option<&str>,
    named: &Named,
) -> Result<Option<NamedConfiguration>, ReferenceFault> {
    let Some(name) = name else { return Ok(None) };
    if let Some((_, problem)) = named.lost.iter().find(|(of, _)| of == name) {
        return Err(ReferenceFault::Position(problem.clone()));
    }
    let all = &named.configurations;
    if let Some(found) = all.iter().find(|one| one.name.as_str() == name) {
        return Ok(Some(found.clone()));
    }
    if name == DEFAULT {
        return Ok(None);
    }
    let known = all.iter().map(|one| Short::of(one.name.as_str())).collect();
    Err(ReferenceFault::Unknown { name: Short::of(name), known })
}

/// A person's decisions without what followed from an earlier reference. Without a new one, pairs that touch in the default
/// configuration are skipped again.
pub(super) fn without_reference(mut decisions: Decisions, is_new: bool) -> Decisions {
    decisions.edits.retain(|edit| edit.reference().is_none());
    if !is_new {
        decisions.skipped_reasons.push(SkippedReason::Default);
    }
    decisions
}
