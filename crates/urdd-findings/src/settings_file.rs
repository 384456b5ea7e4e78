//! Reads a file with settings: `urdd.toml`.

use std::path::{Path, PathBuf};

use super::file_error::{self, FileError};
use super::settings::{Parsed, Settings, SettingsError};

/// The usual name of a settings file.
pub const SETTINGS_FILE: &str = "urdd.toml";
/// Maximum size of a settings file, in bytes.
const MAX_SETTINGS_BYTES: u64 = 1 << 20;

/// The settings file in a folder, or in the nearest one above it. `None` for a relative folder.
pub fn nearest(folder: &Path) -> Option<PathBuf> {
    if !folder.is_absolute() {
        return None;
    }
    let mut files = folder.ancestors().map(|above| above.join(SETTINGS_FILE));
    files.find(|file| file.is_file())
}

/// The content of a settings file.
#[derive(Debug, Clone, Default)]
pub struct SettingsFile {
    /// How URDDs and URDFs are examined and reported.
    pub settings: Settings,
    /// The file with findings that `urdd lint` leaves out; names in it are seen from the settings file's folder.
    pub baseline: Option<PathBuf>,
}

/// What is wrong with a settings file, and where.
pub type SettingsFileError = FileError<SettingsError>;

impl SettingsFile {
    /// Reads a settings file.
    ///
    /// # Errors
    /// If it cannot be read, or [`Settings::from_toml`] refuses it.
    pub fn read(file: &Path) -> Result<SettingsFile, SettingsFileError> {
        let parsed = file_error::read(file, MAX_SETTINGS_BYTES, Parsed::new)?;
        let folder = file.parent().unwrap_or(Path::new(""));
        Ok(SettingsFile {
            settings: parsed.settings,
            baseline: parsed.baseline.map(|baseline| folder.join(baseline)),
        })
    }
}
