//! DOFs by name, as positions name them.

use std::collections::HashMap;

use urdd_format::dof::DofModule;

/// The index of each DOF by name; of several DOFs with one name, of the first.
pub(super) type DofIndices<'a> = HashMap<&'a str, usize>;

/// The indices of the DOFs of a robot.
pub(super) fn indices(dof: &DofModule) -> DofIndices<'_> {
    let dofs = dof.dofs.iter().enumerate().rev();
    dofs.map(|(idx, dof)| (dof.name.as_str(), idx)).collect()
}
