//! Reads a file with settings: `urdd.toml`.

use std::path::{Path, PathBuf};

use super::file_error::{self, FileError, FileFault};
use super::robots::DeclaredRobot;
use super::settings::{Parsed, Settings, SettingsError};
use urdd_directory::limits::MAX_TOML_BYTES;

/// The usual name of a settings file.
pub const SETTINGS_FILE: &str = "urdd.toml";

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
    /// The robots that it declares, seen likewise.
    pub robots: Vec<DeclaredRobot>,
}

/// What is wrong with a settings file, and where.
pub type SettingsFileError = FileError<SettingsError>;

impl SettingsFile {
    /// The text of a settings file with lines at its end; what is there stays. A file that is missing is empty.
    ///
    /// # Errors
    /// If it cannot be read, or is not one, before or after.
    pub fn with_lines(file: &Path, lines: &str) -> Result<String, SettingsFileError> {
        let mut text = String::new();
        if file.exists() {
            file_error::read(file, MAX_TOML_BYTES, |found| {
                text.push_str(found);
                Parsed::new(found).map(drop)
            })?;
        }
        let is_open = !text.is_empty() && !text.ends_with('\n');
        text.push_str(if is_open { "\n" } else { "" });
        text.push_str(if text.is_empty() { lines.trim_start() } else { lines });
        match Parsed::new(&text) {
            Ok(_) => Ok(text),
            Err((at, error)) => {
                let fault = FileFault::Content(error);
                Err(FileError { file: file.to_owned(), at, fault })
            }
        }
    }

    /// Reads a settings file.
    ///
    /// # Errors
    /// If it cannot be read, or [`Settings::from_toml`] refuses it.
    pub fn read(file: &Path) -> Result<SettingsFile, SettingsFileError> {
        let parsed = file_error::read(file, MAX_TOML_BYTES, Parsed::new)?;
        Ok(SettingsFile::of(parsed, file.parent().unwrap_or(Path::new(""))))
    }

    /// The settings of a text that was read from a file in a folder.
    ///
    /// # Errors
    /// As [`Settings::from_toml`].
    pub fn from_toml(text: &str, folder: &Path) -> Result<SettingsFile, SettingsError> {
        Ok(SettingsFile::of(Parsed::of_text(text)?, folder))
    }

    fn of(parsed: Parsed, folder: &Path) -> SettingsFile {
        let seen = |robot: DeclaredRobot| DeclaredRobot { file: folder.join(&robot.file), ..robot };
        SettingsFile {
            robots: parsed.robots.into_iter().map(seen).collect(),
            settings: parsed.settings,
            baseline: parsed.baseline.map(|baseline| folder.join(baseline)),
        }
    }
}
