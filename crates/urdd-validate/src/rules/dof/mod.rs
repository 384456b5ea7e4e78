//! DOF: `dof_module`.

mod dof_count_differs;
mod dof_mappings_disagree;
mod dof_misdescribed;
mod dofs_out_of_order;
mod joint_dof_count_wrong;
mod joint_lists_length;
mod mimic_resolved_wrong;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &dof_count_differs::RULE,
    &joint_lists_length::RULE,
    &dof_mappings_disagree::RULE,
    &joint_dof_count_wrong::RULE,
    &dofs_out_of_order::RULE,
    &dof_misdescribed::RULE,
    &mimic_resolved_wrong::RULE,
];
