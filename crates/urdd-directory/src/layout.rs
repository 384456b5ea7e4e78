//! Reserved file and folder names.

use std::path::{Path, PathBuf};

/// Name of the root metadata file.
pub const ROOT_METADATA: &str = "urdd.json";

/// Prefix of the files and folders that a run creates beside a URDD while writing it.
pub const STAGING_PREFIX: &str = ".urdd-";

/// What exports need and a URDD does not say: `NAME.export.toml` beside the folder `NAME` or the archive `NAME.zip`.
#[must_use]
pub fn setup_beside(urdd: &Path) -> PathBuf {
    // `.` and `..` have no name of their own.
    let named = match urdd.file_name() {
        Some(_) => urdd.to_owned(),
        None => urdd.canonicalize().unwrap_or_else(|_| urdd.to_owned()),
    };
    let name = named.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".zip").unwrap_or(&name);
    named.with_file_name(format!("{stem}.export.toml"))
}

/// Whether this is the name of a staging folder, in use or left behind by a crashed run.
pub fn is_staging(name: &str) -> bool {
    // Version 0.1.0 wrote `.NAME.urdd-PROCESS-NUMBER`.
    let of_0_1_0 = || {
        let (_, ending) = name.strip_prefix('.')?.rsplit_once(STAGING_PREFIX)?;
        let (process, number) = ending.split_once('-')?;
        let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        Some(digits(process) && digits(number))
    };
    name.starts_with(STAGING_PREFIX) || of_0_1_0().unwrap_or(false)
}
