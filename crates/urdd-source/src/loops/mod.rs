//! What closes the loops of a robot, from wherever its author says it: URDF+ in the URDF itself, `NAME.loops.toml` beside it,
//! or Extended URDF beside it: a YAML with pairs of links that are to coincide.
//!
//! Facts: V. Batto et al., Extended URDF (2024), and the loader of example-parallel-robots. Frames are those of the two links;
//! `6d` holds position and rotation, `3d` the position.

mod said;
mod urdf_plus;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::Spanned;
use urdd_directory::export_toml::unplaced;
use urdd_directory::file_type;
use urdd_directory::limits::MAX_TOML_BYTES;
use urdd_directory::loops_toml::{FrameTable, LoopTable};
use urdd_directory::yaml::words;
use urdd_format::loops::LoopKind;
use urdd_format::short::Short;
use urdd_xml::Xml;
use urdd_xml::element::{Edit, apply, attribute, children};

use crate::beside::{self, Companion};
use crate::error::SourceError;
use crate::gate::Gate;
use crate::settings::Settings;

pub use said::{Retyped, Said};
pub use urdd_directory::loops_toml::File;
pub(super) use urdf_plus::placed_urdf_plus;
pub use urdf_plus::{CostlyElement, LoopFault, table, urdf_plus};

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
            Ok(text) => is_extended(&text).then_some((path, text)),
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
        (None, Some((path, text))) => read_extended(&path, text).map(Some),
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
        return read_extended(path, text);
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
    let folder = folder.map_err(|why| SourceError::unread(&path.display().to_string(), why))?;
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
    text.map_err(|reason| SourceError::unread(&path.display().to_string(), reason))
}

/// The key by which such a file is known.
const KEY: &str = "closed_loop";

#[derive(Deserialize)]
struct Extended {
    closed_loop: Vec<[String; 2]>,
    #[serde(rename = "type")]
    types: Vec<String>,
    #[serde(default)]
    name_mot: Option<Vec<String>>,
    #[serde(default)]
    joint_name: Option<Vec<String>>,
    #[serde(default)]
    joint_type: Option<Vec<String>>,
}

/// Whether a YAML is such a file.
pub(super) fn is_extended(text: &str) -> bool {
    text.lines().any(|line| line.starts_with(KEY))
}

/// Reads such a file.
pub(super) fn read_extended(path: &Path, text: String) -> Result<Said, SourceError> {
    let shown = path.display().to_string();
    let said = Said { text: Some((shown.clone(), text)), ..Said::default() };
    let refused = |line: usize, column: usize, fault: String| SourceError::Import {
        file: shown.clone(),
        line: u32::try_from(line).unwrap_or(1),
        column: u32::try_from(column).unwrap_or(1),
        fault,
    };
    let text = said.text.as_ref().map_or("", |(_, text)| text);
    let words =
        words::read(text).map_err(|error| refused(error.line, error.column, error.reason))?;
    let read =
        Extended::deserialize(&words.value).map_err(|error| refused(1, 1, error.to_string()))?;
    let key = |key: &str| words.key(key).map(|at| at..at);
    let place =
        |of: &str, number: usize| words.scalar(of, number).map(|at| at..at).or_else(|| key(of));
    let lengths = [
        ("closed_loop", read.closed_loop.len(), "type", read.types.len()),
        (
            "joint_name",
            read.joint_name.as_ref().map_or(0, Vec::len),
            "joint_type",
            read.joint_type.as_ref().map_or(0, Vec::len),
        ),
    ];
    for (a, of_a, b, of_b) in lengths {
        if of_a != of_b {
            let fault =
                format!("`{a}` and `{b}` need as many entries: there are {of_a} and {of_b}");
            return Err(said.error(key(b), &shown, fault));
        }
    }
    let mut file = File::default();
    let link = |name: String, number: usize| {
        Spanned::new(place(KEY, number).unwrap_or(0..0), name)
    };
    for (number, ([a, b], word)) in read.closed_loop.into_iter().zip(&read.types).enumerate() {
        let kind = match word.to_ascii_lowercase().as_str() {
            "6d" => LoopKind::Fixed,
            "3d" => LoopKind::Spherical,
            _ => {
                let fault = format!("`{}` in `type` is neither 6d nor 3d", word.escape_debug());
                return Err(said.error(place("type", number), &shown, fault));
            }
        };
        let table = LoopTable {
            name: a.clone(),
            kind,
            link_a: link(a, 2 * number),
            frame_a: FrameTable::default(),
            link_b: link(b, 2 * number + 1),
            frame_b: FrameTable::default(),
        };
        file.loops.push(Spanned::new(table.link_a.span(), table));
    }
    file.independent = read.name_mot.map(|names| names.into_iter().map(unplaced).collect());
    let mut retyped = Vec::new();
    let kinds = read.joint_type.unwrap_or_default();
    let joints = read.joint_name.unwrap_or_default().into_iter().zip(kinds).enumerate();
    let mut known: HashMap<String, Retyped> = HashMap::new();
    for (number, (joint, word)) in joints {
        let Some(kind) = Retyped::of(&word) else {
            let at = place("joint_type", number);
            let (word, joint) = (word.escape_debug(), joint.escape_debug());
            let fault = format!(
                "the joint `{joint}` is to be `{word}`: there are SPHERICAL, FIXED, and UJOINT_ with two of X, Y and Z"
            );
            return Err(said.error(at, &shown, fault));
        };
        match known.insert(joint.clone(), kind) {
            None => retyped.push((joint, kind)),
            Some(other) if other == kind => {}
            Some(_) => {
                let joint = Short::of(&joint);
                let fault = format!(
                    "the joint `{joint}` is named twice, and is to be two different joints: name it once"
                );
                return Err(said.error(place("joint_name", number), &shown, fault));
            }
        }
    }
    Ok(Said { file, retyped, ..said })
}

impl Retyped {
    fn of(word: &str) -> Option<Self> {
        match word {
            "SPHERICAL" => Some(Retyped::Spherical),
            "FIXED" => Some(Retyped::Fixed),
            _ => {
                let axes: Vec<char> = word.strip_prefix("UJOINT_")?.chars().collect();
                let axes: [char; 2] = axes.try_into().ok()?;
                axes.iter().all(|axis| "XYZ".contains(*axis)).then_some(Retyped::Universal(axes))
            }
        }
    }
}

fn unit(axis: char) -> &'static str {
    match axis {
        'X' => "1 0 0",
        'Y' => "0 1 0",
        _ => "0 0 1",
    }
}

/// The text of a URDF with other types of joints, and the names of joints that it does not have. A universal joint `NAME`
/// becomes two, `NAME_Z` and `NAME_Y`, with the link `NAME_Z` between.
pub fn retyped(xml: &Xml<'_>, joints: &[(String, Retyped)]) -> (String, Vec<String>) {
    let Ok(document) = xml.document() else { return (xml.text().to_owned(), Vec::new()) };
    let mut edits: Vec<Edit> = Vec::new();
    let mut named = HashMap::new();
    for (_, element) in children(document.root_element()).filter(|(word, _)| *word == "joint") {
        if let Some(name) = attribute(element, "name") {
            named.entry(name.value()).or_insert(element);
        }
    }
    let mut missing = Vec::new();
    for (name, kind) in joints {
        let Some(joint) = named.get(name.as_str()).copied() else {
            missing.push(name.clone());
            continue;
        };
        let inside = |name: &str| children(joint).find(|(word, _)| *word == name).map(|(_, it)| it);
        let child = inside("child").and_then(|child| attribute(child, "link"));
        let (Some(named), Some(of_type), Some(child)) =
            (attribute(joint, "name"), attribute(joint, "type"), child)
        else {
            continue;
        };
        let mut edit = |range, text: String| edits.push(Edit { range, text });
        match kind {
            Retyped::Spherical => edit(of_type.range_value(), "spherical".to_owned()),
            Retyped::Fixed => edit(of_type.range_value(), "fixed".to_owned()),
            Retyped::Universal([first, second]) => {
                let raw = &xml.text()[named.range_value()];
                let between = format!("{raw}_{first}");
                edit(of_type.range_value(), "continuous".to_owned());
                edit(named.range_value(), between.clone());
                let last = xml.text()[child.range_value()].to_owned();
                edit(child.range_value(), between.clone());
                let axis = format!("<axis xyz=\"{}\"/>", unit(*first));
                match inside("axis") {
                    Some(old) => edit(old.range(), axis),
                    None => {
                        let end = inside("child").map_or(0, |child| child.range().end);
                        edit(end..end, axis);
                    }
                }
                let end = joint.range().end;
                let more = format!(
                    "\n  <link name=\"{between}\"/>\n  <joint name=\"{raw}_{second}\" type=\"continuous\"><parent link=\"{between}\"/><child link=\"{last}\"/><axis xyz=\"{}\"/></joint>",
                    unit(*second)
                );
                edit(end..end, more);
            }
        }
    }
    (apply(xml.text(), edits), missing)
}
