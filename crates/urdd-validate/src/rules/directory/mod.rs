//! DIR: files and folders, and the root metadata.

mod class_incomplete;
mod dependencies;
mod draft_format;
mod file_changed;
mod file_list_incomplete;
mod listed;
pub(super) mod listed_files;
mod lists;
mod missing;
mod names;
mod source_file;
mod stray_file;
pub(crate) mod unknown_major_version;
mod unknown_module;
mod unreadable_file;
mod versions;

use crate::rule::rules;
use listed_files::listed_files;

rules! {
    class_incomplete, dependencies, draft_format, lists, file_changed,
    file_list_incomplete, listed, missing, names, source_file, stray_file, unknown_major_version,
    unknown_module, unreadable_file, versions
}
