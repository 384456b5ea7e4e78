//! Reserved file and folder names.

/// Name of the root metadata file.
pub const ROOT_METADATA: &str = "urdd.json";

/// Prefix of the files and folders that a run creates beside a URDD while writing it.
pub const STAGING_PREFIX: &str = ".urdd-";

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
