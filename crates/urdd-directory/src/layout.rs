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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn staging_folders_are_known_by_name() {
        for name in [".urdd-0123456789abcdef", ".ur5.urdd-4711-0", ".a.urdd-1-2.urdd-3-4"] {
            assert!(is_staging(name), "{name}");
        }
        for name in ["ur5", ".ur5", "ur5.urdd-1-2", ".ur5.urdd-1", ".ur5.urdd-a-b", ".git"] {
            assert!(!is_staging(name), "{name}");
        }
    }
}
