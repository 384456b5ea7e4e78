//! DIR: what lies in the directory, and the root metadata.

mod bad_path;
mod class_incomplete;
mod dependency_missing;
mod draft_format;
mod file_changed;
mod file_list_incomplete;
mod link_leaves_root;
mod list_out_of_order;
mod listed_file_missing;
mod listed_module_missing;
mod module_entry_wrong;
mod module_json_missing;
mod module_version_unknown;
mod module_yaml_missing;
mod name_not_utf8;
mod names_differ_in_case;
mod newer_version;
mod robot_name_differs;
mod root_metadata_missing;
mod source_not_in_root;
mod source_not_named;
mod stray_file;
pub(crate) mod unknown_major_version;
mod unknown_module;
mod unlisted_module;
mod unreadable_file;
mod version_differs;
mod version_malformed;
mod version_missing;
mod wrong_dependencies;

use crate::rule::Rule;

/// The rules of this family.
pub const RULES: &[&Rule] = &[
    &root_metadata_missing::RULE,
    &listed_module_missing::RULE,
    &unlisted_module::RULE,
    &module_json_missing::RULE,
    &version_missing::RULE,
    &version_malformed::RULE,
    &version_differs::RULE,
    &module_version_unknown::RULE,
    &newer_version::RULE,
    &module_yaml_missing::RULE,
    &listed_file_missing::RULE,
    &file_list_incomplete::RULE,
    &stray_file::RULE,
    &file_changed::RULE,
    &bad_path::RULE,
    &link_leaves_root::RULE,
    &dependency_missing::RULE,
    &wrong_dependencies::RULE,
    &class_incomplete::RULE,
    &robot_name_differs::RULE,
    &module_entry_wrong::RULE,
    &unknown_module::RULE,
    &unreadable_file::RULE,
    &name_not_utf8::RULE,
    &unknown_major_version::RULE,
    &list_out_of_order::RULE,
    &names_differ_in_case::RULE,
    &source_not_in_root::RULE,
    &source_not_named::RULE,
    &draft_format::RULE,
];
