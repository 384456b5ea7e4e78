//! Reads a file with settings: `urdd.toml`.

use std::fmt;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::settings::{Parsed, Settings, SettingsError};
use urdd_directory::position::Position;
use urdd_directory::read_error::ReadError;
use urdd_directory::regular;
use urdd_format::escape;

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
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SettingsFileError {
    /// The file, as it was named.
    pub file: PathBuf,
    /// Where in the file.
    pub at: Option<Position>,
    /// What is wrong.
    pub fault: SettingsFileFault,
}

/// What is wrong with a settings file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SettingsFileFault {
    /// It cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Not UTF-8.
    #[error("it is not UTF-8")]
    NotUtf8,
    /// It has something that is not a setting.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

impl SettingsFile {
    /// Reads a settings file.
    ///
    /// # Errors
    /// If it cannot be read, or [`Settings::from_toml`] refuses it.
    pub fn read(file: &Path) -> Result<SettingsFile, SettingsFileError> {
        let refused = |at, fault| SettingsFileError { file: file.to_owned(), at, fault };
        let bytes = regular::read(file, MAX_SETTINGS_BYTES);
        let bytes = bytes.map_err(|error| refused(None, error.into()))?;
        let text = String::from_utf8(bytes);
        let text = text.map_err(|_| refused(None, SettingsFileFault::NotUtf8))?;
        let parsed = Parsed::new(&text);
        let parsed = parsed.map_err(|(at, error)| refused(at, error.into()))?;
        let folder = file.parent().unwrap_or(Path::new(""));
        Ok(SettingsFile {
            settings: parsed.settings,
            baseline: parsed.baseline.map(|baseline| folder.join(baseline)),
        })
    }
}

impl std::error::Error for SettingsFileError {}

impl fmt::Display for SettingsFileError {
    fn fmt(&self, out: &mut fmt::Formatter) -> fmt::Result {
        let shown = self.file.display().to_string();
        write!(out, "{}", escape::line(&shown))?;
        if let Some(at) = self.at {
            write!(out, ":{at}")?;
        }
        write!(out, ": {}", self.fault)
    }
}
