//! What closes the loops of a robot, from wherever its author says it: URDF+ in the URDF itself, `NAME.loops.toml` beside it,
//! or the YAML of Extended URDF beside it.

mod extended;
mod said;
mod urdf_plus;

use std::path::{Path, PathBuf};

pub use extended::retyped;
pub use said::{Retyped, Said};
use urdd_directory::limits::MAX_TOML_BYTES;
pub use urdd_directory::loops_toml::File;
pub use urdf_plus::urdf_plus;

use super::error::SourceError;
use super::settings::Settings;

/// The ending of the file beside a URDF.
const ENDING: &str = "loops.toml";
/// The ending of Extended URDF's.
const EXTENDED: &str = "yaml";

/// Reads the file that is named in the settings, or the one beside a URDF, if there is one.
///
/// # Errors
/// If it cannot be read, or is not what its name says.
pub fn beside(urdf: &Path, settings: &Settings) -> Result<Option<Said>, SourceError> {
    if let Some(path) = &settings.loops {
        return read(path, settings).map(Some);
    }
    let there = |path: &PathBuf| settings.files.is_file(path);
    if let Some(path) = Some(urdf.with_extension(ENDING)).filter(there) {
        return read(&path, settings).map(Some);
    }
    // A YAML of this name may be about anything.
    let Some(path) = Some(urdf.with_extension(EXTENDED)).filter(there) else { return Ok(None) };
    let text = text(&path, settings)?;
    match text.lines().any(|line| line.starts_with(extended::KEY)) {
        true => extended::read(&path, text).map(Some),
        false => Ok(None),
    }
}

fn read(path: &Path, settings: &Settings) -> Result<Said, SourceError> {
    let text = text(path, settings)?;
    if path.extension().is_none_or(|ending| ending != "toml") {
        return extended::read(path, text);
    }
    let shown = path.display().to_string();
    match toml::from_str(&text) {
        Ok(file) => Ok(Said { file, text: Some((shown, text)), ..Said::default() }),
        Err(error) => {
            let said = Said { text: Some((shown.clone(), text)), ..Said::default() };
            Err(said.error(error.span(), &shown, error.message().to_owned()))
        }
    }
}

fn text(path: &Path, settings: &Settings) -> Result<String, SourceError> {
    let file = path.display().to_string();
    let unreadable = |reason: String| SourceError::Read { file: file.clone(), reason };
    let bytes = settings.files.read(path, MAX_TOML_BYTES);
    let bytes = bytes.map_err(|error| unreadable(error.to_string()))?;
    String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8".to_owned()))
}
