//! DIR: files and folders, and the root metadata.

pub(super) mod edition;
mod file_changed;
mod listed;
mod metadata;
mod missing;
mod names;
mod source_file;
mod unnamed;
mod unreadable_file;
mod versions;

use crate::rule::rules;

rules! {
    edition, metadata, file_changed, listed, missing, names, source_file, unnamed,
    unreadable_file, versions
}
