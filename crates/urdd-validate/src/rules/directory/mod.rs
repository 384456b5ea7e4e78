//! DIR: files and folders, and the root metadata.

mod bad_path;
mod class_incomplete;
mod dependency_missing;
mod draft_format;
mod file_changed;
mod file_list_incomplete;
mod link_leaves_root;
mod list_out_of_order;
mod listed_file_missing;
pub(super) mod listed_files;
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

use crate::rule::rules;
use listed_files::listed_files;

rules! {
    bad_path, class_incomplete, dependency_missing, draft_format, file_changed,
    file_list_incomplete, link_leaves_root, list_out_of_order, listed_file_missing,
    listed_module_missing, module_entry_wrong, module_json_missing, module_version_unknown,
    module_yaml_missing, name_not_utf8, names_differ_in_case, newer_version, robot_name_differs,
    root_metadata_missing, source_not_in_root, source_not_named, stray_file,
    unknown_major_version, unknown_module, unlisted_module, unreadable_file, version_differs,
    version_malformed, version_missing, wrong_dependencies
}
