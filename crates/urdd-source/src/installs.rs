//! Reads what a package installs.

use std::path::Path;

use crate::files::Files;
use crate::installed::Installed;
use crate::{cmake, setup_py};
use urdd_directory::limits::MAX_MANIFEST_BYTES;

/// Maximum number of files and folders that a package installs one by one.
const MAX_RULES: usize = 1000;

/// Reads what the package in a folder says.
pub fn installed(folder: &Path, files: &Files) -> Installed {
    let read = |name: &str| {
        let bytes = files.read(&folder.join(name), MAX_MANIFEST_BYTES).ok()?;
        Some(String::from_utf8_lossy(&bytes).into_owned())
    };
    let mut installed = match (read("CMakeLists.txt"), read("setup.py")) {
        (Some(text), _) => cmake::installed(&text),
        (None, Some(text)) => setup_py::installed(&text),
        (None, None) => Installed::default(),
    };
    installed.rules.truncate(MAX_RULES);
    installed
}
