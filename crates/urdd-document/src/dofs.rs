//! Version-independent view of `dof_module`.

use urdd_format::dof::DofModule;
use urdd_format::index::{Count, DofIdx, JointIdx};
use urdd_format::registry::ModuleDocument;

/// The degrees of freedom.
#[derive(Debug, Clone, Copy)]
pub struct Dofs<'a> {
    /// Number of DOFs.
    pub num_dofs: Count,
    /// Joint of each DOF.
    pub joint_of_dof: &'a [JointIdx],
    /// DOFs of each joint.
    pub dofs_of_joint: &'a [Vec<DofIdx>],
    /// The module, if it is of version 1, which has more fields.
    pub v1: Option<&'a DofModule>,
}

/// The view of a `dof_module`.
pub fn view(document: &ModuleDocument) -> Option<Dofs<'_>> {
    match document {
        ModuleDocument::Dof(module) => Some(Dofs {
            num_dofs: module.num_dofs,
            joint_of_dof: &module.dof_idx_to_joint_idx_mapping,
            dofs_of_joint: &module.joint_idx_to_dof_idxs_mapping,
            v1: Some(module),
        }),
        ModuleDocument::LegacyDof(module) => Some(Dofs {
            num_dofs: module.num_dofs,
            joint_of_dof: &module.dof_idx_to_joint_idx_mapping,
            dofs_of_joint: &module.joint_idx_to_dof_idxs_mapping,
            v1: None,
        }),
        _ => None,
    }
}
