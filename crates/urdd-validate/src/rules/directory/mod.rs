//! DIR: files and folders, and the root metadata.

pub(super) mod edition;
mod file_changed;
mod listed;
mod metadata;
mod names;
mod unnamed;
mod versions;

use crate::rule::rules;

rules! {
    edition, metadata, file_changed, listed, names, unnamed, versions
}
