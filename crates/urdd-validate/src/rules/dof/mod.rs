//! DOF: `dof_module`.

pub mod dof_count_differs;
pub mod dof_mappings_disagree;
pub mod dof_misdescribed;
pub mod dofs_out_of_order;
pub mod joint_dof_count_wrong;
pub mod joint_lists_length;
pub mod mimic_resolved_wrong;

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
