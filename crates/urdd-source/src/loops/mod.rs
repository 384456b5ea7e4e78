//! What closes the loops of a robot, from wherever its author says it: URDF+ in the URDF itself, `NAME.loops.toml` beside it,
//! or the YAML of Extended URDF beside it.

mod extended;
mod said;
mod urdf_plus;

use std::path::{Path, PathBuf};

pub use extended::retyped;
pub use said::{Retyped, Said};
use urdd_directory::file_type;
use urdd_directory::limits::MAX_TOML_BYTES;
pub use urdd_directory::loops_toml::File;
pub(super) use urdf_plus::placed_urdf_plus;
pub use urdf_plus::{LoopFault, table, urdf_plus};

use super::beside::{self, Companion};
use super::error::SourceError;
use super::gate::Gate;
use super::settings::Settings;

/// The ending of the file beside a URDF.
const ENDING: &str = "loops.toml";
/// The ending of Extended URDF's.
const EXTENDED: &str = "yaml";

/// Reads the file that is named in the settings, or the one beside a URDF, if there is one. A second one beside it is passed
/// over with a note.
///
/// # Errors
/// If it cannot be read, or is not what its name says.
pub fn beside(urdf: &Path, settings: &Settings) -> Result<Option<Said>, SourceError> {
    if settings.loops.is_some() {
        return named(settings);
    }
    let stem = file_type::stem(urdf);
    let at = |ending: &str| urdf.with_file_name(format!("{stem}.{ending}"));
    let files = &settings.files;
    // A folder, a pipe or a link that leads nowhere is refused when it is read.
    let is_there = |path: &PathBuf| files.exists(path) || files.is_dangling(path);
    let toml = Some(at(ENDING)).filter(is_there);
    // A YAML of this name may be about anything.
    let yaml = match Some(at(EXTENDED)).filter(|path| files.is_file(path)) {
        Some(path) => match beside_text(&path, settings) {
            Ok(text) => extended::is_one(&text).then_some((path, text)),
            Err(_) if toml.is_some() => None,
            Err(error) => return Err(error),
        },
        None => None,
    };
    match (toml, yaml) {
        (Some(path), yaml) => {
            let mut said = read(&path, beside_text(&path, settings)?)?;
            said.notes.extend(yaml.map(|(yaml, _)| said.passed_over(&yaml.display().to_string())));
            Ok(Some(said))
        }
        (None, Some((path, text))) => extended::read(&path, text).map(Some),
        (None, None) => Ok(None),
    }
}

/// Reads the file that is named in the settings, if one is.
///
/// # Errors
/// Those of [`beside()`].
pub fn named(settings: &Settings) -> Result<Option<Said>, SourceError> {
    settings.loops.as_ref().map(|path| read(path, text(path, settings)?)).transpose()
}

fn read(path: &Path, text: String) -> Result<Said, SourceError> {
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

/// The text of the file that a person names.
fn text(path: &Path, settings: &Settings) -> Result<String, SourceError> {
    let bytes = settings.files.read(path, MAX_TOML_BYTES).map_err(|error| error.to_string());
    decoded(path, bytes.and_then(beside::text))
}

/// The text of one that is found by its name: no link leads out of the robot's folders.
fn beside_text(path: &Path, settings: &Settings) -> Result<String, SourceError> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = settings.files.canonicalize(folder.unwrap_or(Path::new(".")));
    let folder = folder.map_err(|error| SourceError::Read {
        file: path.display().to_string(),
        reason: error.to_string(),
    })?;
    let gate = Gate::of_project(&folder, settings);
    let text = beside::companion(path, MAX_TOML_BYTES, &gate).unwrap_or_else(|| {
        let is_dangling = settings.files.is_dangling(path);
        let why =
            if is_dangling { "it is a link that leads nowhere" } else { "it cannot be opened" };
        Err(why.to_owned())
    });
    decoded(path, text)
}

fn decoded(path: &Path, text: Companion) -> Result<String, SourceError> {
    // A byte order mark is no part of the text.
    let text = text.map(|text| text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text));
    text.map_err(|reason| SourceError::Read { file: path.display().to_string(), reason })
}
