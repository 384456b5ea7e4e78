//! `dof_module`, whatever its version.

use urdd_format::dof::DofModule;
use urdd_format::index::{Count, DofIdx, JointIdx};
use urdd_format::registry::ModuleDocument;

/// The degrees of freedom.
#[derive(Debug, Clone, Copy)]
pub struct Dofs<'a> {
    /// Number of DOFs.
    pub num_dofs: Count,
    /// For each DOF, its joint.
    pub joint_of_dof: &'a [JointIdx],
    /// For each joint, its DOFs.
    pub dofs_of_joint: &'a [Vec<DofIdx>],
    /// The module of version 1, which says more.
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
