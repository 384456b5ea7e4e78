//! DIR: what lies in the directory, and the root metadata.

pub mod bad_path;
pub mod class_incomplete;
pub mod dependency_missing;
pub mod draft_format;
pub mod file_changed;
pub mod file_list_incomplete;
pub mod link_leaves_root;
pub mod list_out_of_order;
pub mod listed_file_missing;
pub mod listed_module_missing;
pub mod module_entry_wrong;
pub mod module_json_missing;
pub mod module_version_unknown;
pub mod module_yaml_missing;
pub mod name_not_utf8;
pub mod names_differ_in_case;
pub mod newer_version;
pub mod robot_name_differs;
pub mod root_metadata_missing;
pub mod source_not_in_root;
pub mod source_not_named;
pub mod stray_file;
pub mod unknown_major_version;
pub mod unknown_module;
pub mod unlisted_module;
pub mod unreadable_file;
pub mod version_differs;
pub mod version_malformed;
pub mod version_missing;
pub mod wrong_dependencies;

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
