//! The files that `urdd.json` lists.

use std::collections::HashSet;
use urdd_format::root_metadata::RootMetadata;

/// The files that `urdd.json` lists as those of modules.
pub(in crate::rules) fn listed_files(metadata: &RootMetadata) -> HashSet<&str> {
    let files = metadata.modules.iter().flat_map(|module| &module.files);
    files.map(|file| file.path.as_str()).collect()
}
