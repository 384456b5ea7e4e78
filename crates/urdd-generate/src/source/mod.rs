//! The source: from a file to a robot, and to the text that the URDD carries.

mod decode;
mod repair;
pub(crate) mod xacro;

use std::path::{Path, PathBuf};

use super::bounded::{MAX_SOURCE_BYTES, read_file};
use super::error::GenerateError;
use super::fault::{Fault, PlacedFault};
use super::meshes::package::Packages;
use super::note::{Note, Remark};
use super::urdf::{self, Reading};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::path::portable;
use urdd_directory::position::LineIndex;
use urdd_format::urdf::UrdfModule;

use urdd_xml::element::apply;
pub use xacro::XacroSettings;

/// How often a text is repaired at most; once is enough, unless this program is wrong.
const MOST_ROUNDS: usize = 4;

/// A source that was read.
#[derive(Debug)]
pub(crate) struct Source {
    /// The file, as the user named it.
    pub shown: String,
    /// The folder that the file lies in: relative mesh names begin here.
    pub folder: PathBuf,
    /// The name under which it is carried.
    pub file_name: String,
    /// What is carried: the file as it was found, or repaired, or expanded.
    pub carried: Vec<u8>,
    /// The file as it was found, where something else is carried.
    pub found: Option<Vec<u8>>,
    /// The robot.
    pub reading: Reading,
    /// What is odd in it.
    pub notes: Vec<Note>,
    /// Where each mesh is named, as line and column of the file (reading.mesh_offsets).
    pub mesh_places: Vec<(u32, u32)>,
}

impl Source {
    /// An error about the robot as a whole.
    pub fn refused(&self, fault: Fault) -> GenerateError {
        GenerateError::Refused {
            file: self.shown.clone(),
            faults: vec![PlacedFault {
                line: 1,
                column: 1,
                fault,
            }],
        }
    }
}

/// Reads a URDF, or a xacro file that makes one.
///
/// # Errors
/// Where it cannot be read, or is no robot.
pub(crate) fn load(
    path: &Path,
    xacro: &XacroSettings,
    packages: &Packages,
    cancellation: &Cancellation,
) -> Result<Source, GenerateError> {
    let shown = path.display().to_string();
    let unreadable = |reason: String| GenerateError::Read {
        file: shown.clone(),
        reason,
    };
    let bytes = read_file(path, MAX_SOURCE_BYTES).map_err(unreadable)?;
    let canonical = path
        .canonicalize()
        .map_err(|error| unreadable(error.to_string()))?;
    let folder = canonical
        .parent()
        .map_or_else(|| PathBuf::from("."), Path::to_owned);

    let mut notes = Vec::new();
    let (mut text, mut is_verbatim) = decode::decode(&bytes, &shown, &mut notes)?;
    // The user's name for it counts, not the file that a link leads to.
    let is_xacro_file = path
        .extension()
        .is_some_and(|extension| extension == "xacro");
    if is_xacro_file || (xacro.expand_urdf && text.contains("<xacro:")) {
        text = xacro::expand(path, &shown, xacro, packages, cancellation)?;
        is_verbatim = false;
    }
    let names = names(&canonical);
    source(Read {
        shown,
        folder,
        names,
        bytes,
        text,
        is_verbatim,
        notes,
    })
}

/// Takes a URDF from memory, as it came through a pipe; relative names begin in `folder`.
///
/// # Errors
/// Where it is no robot.
pub(crate) fn load_text(
    bytes: Vec<u8>,
    shown: &str,
    folder: &Path,
) -> Result<Source, GenerateError> {
    let shown = shown.to_owned();
    let unreadable = |reason: String| GenerateError::Read {
        file: shown.clone(),
        reason,
    };
    if bytes.len() as u64 > MAX_SOURCE_BYTES {
        let limit = MAX_SOURCE_BYTES >> 20;
        return Err(unreadable(format!("it is longer than {limit} MiB")));
    }
    let folder = folder
        .canonicalize()
        .map_err(|error| unreadable(error.to_string()))?;
    let mut notes = Vec::new();
    let (text, is_verbatim) = decode::decode(&bytes, &shown, &mut notes)?;
    let names = names(Path::new("robot.urdf"));
    source(Read {
        shown,
        folder,
        names,
        bytes,
        text,
        is_verbatim,
        notes,
    })
}

/// A source whose text is there.
struct Read {
    shown: String,
    folder: PathBuf,
    /// The file's name without its extensions, and the name under which it is carried.
    names: (String, String),
    bytes: Vec<u8>,
    text: String,
    /// Whether the text is that of the bytes.
    is_verbatim: bool,
    notes: Vec<Note>,
}

fn source(read: Read) -> Result<Source, GenerateError> {
    let Read {
        shown,
        folder,
        names,
        bytes,
        text,
        mut is_verbatim,
        mut notes,
    } = read;
    let (name, file_name) = names;
    let mended = mend(text, &name, &shown, &mut notes)?;
    is_verbatim &= mended.is_verbatim;
    Ok(Source {
        folder,
        file_name,
        carried: match is_verbatim {
            true => bytes.clone(),
            false => mended.text.into_bytes(),
        },
        found: (!is_verbatim).then_some(bytes),
        reading: mended.reading,
        notes,
        mesh_places: mended.mesh_places,
        shown,
    })
}

/// A robot as [`generate`](super::generate) reads it.
#[derive(Debug, Clone, PartialEq)]
pub struct SourceRobot {
    /// What a `urdf_module` says of it.
    pub robot: UrdfModule,
    /// The URDF that a URDD carries: the one that was read, repaired where it had to be.
    pub carried: Vec<u8>,
    /// What is odd in it.
    pub notes: Vec<Note>,
}

/// Reads a URDF from memory, and makes nothing. Macros of xacro are not expanded.
///
/// `name` names a robot that has no name, and stands for the file in notes and errors.
///
/// # Errors
/// Where it cannot be read, or is no robot.
pub fn read_urdf(bytes: &[u8], name: &str) -> Result<SourceRobot, GenerateError> {
    let mut notes = Vec::new();
    let (text, is_verbatim) = decode::decode(bytes, name, &mut notes)?;
    let mended = mend(text, name, name, &mut notes)?;
    Ok(SourceRobot {
        robot: mended.reading.robot,
        carried: match is_verbatim && mended.is_verbatim {
            true => bytes.to_owned(),
            false => mended.text.into_bytes(),
        },
        notes,
    })
}

/// A text that says what was read of it.
struct Mended {
    text: String,
    /// Whether nothing had to be repaired.
    is_verbatim: bool,
    reading: Reading,
    mesh_places: Vec<(u32, u32)>,
}

/// Reads a robot, and repairs its text until that says what was read.
fn mend(
    text: String,
    name: &str,
    shown: &str,
    notes: &mut Vec<Note>,
) -> Result<Mended, GenerateError> {
    let (mut text, remarks, first_line) = repair::mend_xml(text);
    let mut is_verbatim = remarks.is_empty();
    place(&remarks, &text, shown, first_line, notes);

    let mut mesh_places = None;
    for _ in 0..MOST_ROUNDS {
        let refused = |mut faults: Vec<PlacedFault>| {
            for placed in &mut faults {
                placed.line += first_line;
            }
            GenerateError::Refused {
                file: shown.to_owned(),
                faults,
            }
        };
        let reading = urdf::read(&text, name).map_err(refused)?;
        if mesh_places.is_none() {
            // Later texts are repaired ones, and their places mean nothing to the user.
            place(&reading.remarks, &text, shown, first_line, notes);
            let lines = LineIndex::new(&text);
            let places = reading.mesh_offsets.iter().map(|offset| {
                let at = lines.position(*offset);
                (at.line + first_line, at.column)
            });
            mesh_places = Some(places.collect());
        }
        if reading.edits.is_empty() {
            return Ok(Mended {
                text,
                is_verbatim,
                reading,
                mesh_places: mesh_places.unwrap_or_default(),
            });
        }
        is_verbatim = false;
        text = apply(&text, reading.edits);
    }
    Err(GenerateError::Internal {
        file: shown.to_owned(),
        reason: "the repaired URDF needs repairs again".to_owned(),
    })
}

fn place(remarks: &[Remark], text: &str, file: &str, first_line: u32, notes: &mut Vec<Note>) {
    let lines = LineIndex::new(text);
    notes.extend(remarks.iter().map(|remark| {
        let at = lines.position(remark.offset);
        Note {
            kind: remark.kind,
            file: file.to_owned(),
            line: at.line + first_line,
            column: at.column,
            problem: remark.problem.clone(),
            assumed: remark.assumed.clone(),
        }
    }));
}

/// The file's name without its extensions, and the name under which it is carried.
fn names(path: &Path) -> (String, String) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let mut stem: &str = &name;
    for extension in [".xacro", ".xml", ".urdf"] {
        stem = stem.strip_suffix(extension).unwrap_or(stem);
    }
    let stem = if stem.is_empty() { "robot" } else { stem };
    let file_name = portable(&format!("{stem}.urdf"));
    (stem.to_owned(), file_name)
}
