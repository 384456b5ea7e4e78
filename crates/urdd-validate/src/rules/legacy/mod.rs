//! LEG: conventions of URDDs that were published before version 1.

mod adjusted_mappings_wrong;
mod folder_name_differs;
mod locked_bound_widened;
mod mesh_file_shared_alike;
mod parent_relative_paths;
mod without_root_metadata;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &without_root_metadata::RULE,
    &parent_relative_paths::RULE,
    &folder_name_differs::RULE,
    &adjusted_mappings_wrong::RULE,
    &locked_bound_widened::RULE,
    &mesh_file_shared_alike::RULE,
];
