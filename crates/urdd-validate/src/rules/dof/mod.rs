//! DOF: `dof_module`.

pub mod dof_count_differs;
pub mod dof_mappings_disagree;
mod dof_misdescribed;
mod dofs_out_of_order;
mod joint_dof_count_wrong;
mod joint_lists_length;
mod mimic_resolved_wrong;

use crate::rule::rules;

rules! {
    dof_count_differs, dof_mappings_disagree, dof_misdescribed, dofs_out_of_order,
    joint_dof_count_wrong, joint_lists_length, mimic_resolved_wrong
}
