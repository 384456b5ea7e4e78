//! LEG: conventions of URDDs that were published before version 1.

pub mod adjusted_mappings_wrong;
mod folder_name_differs;
mod locked_bound_widened;
mod mesh_file_shared_alike;
mod parent_relative_paths;
mod without_root_metadata;

use crate::rule::rules;

rules! {
    adjusted_mappings_wrong, folder_name_differs, locked_bound_widened, mesh_file_shared_alike,
    parent_relative_paths, without_root_metadata
}
