//! Reads the source file: yields the robot and the text that the URDD stores.

mod decode;
pub(crate) mod includes;
pub(crate) mod repair;
pub(crate) mod xacro;

use std::path::{Path, PathBuf};

use super::bounded::MAX_SOURCE_BYTES;
use super::error::GenerateError;
use super::fault::{Fault, PlacedFault};
use super::meshes::package::Packages;
use super::note::{Note, Remark};
use super::urdf::{self, Reading};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::path::portable;
use urdd_directory::position::LineIndex;
use urdd_directory::regular;
use urdd_format::urdf::UrdfModule;

use urdd_xml::element::apply;
pub use xacro::XacroSettings;

/// Maximum number of repair rounds; one is enough unless this program has a bug.
const MOST_ROUNDS: usize = 4;

/// A source after reading.
#[derive(Debug)]
pub(crate) struct Source {
    /// The file, as the user named it.
    pub shown: String,
    /// The folder of the file; relative mesh names refer to it.
    pub folder: PathBuf,
    /// The file name in the URDD.
    pub file_name: String,
    /// The stored bytes: the file as found, repaired, or expanded.
    pub carried: Vec<u8>,
    /// The file as found, if the stored bytes differ.
    pub found: Option<Vec<u8>>,
    /// The robot.
    pub reading: Reading,
    /// Deviations in the source.
    pub notes: Vec<Note>,
    /// The line and column in the file of each mesh in `reading.mesh_offsets`.
    pub mesh_places: Vec<(u32, u32)>,
}

impl Source {
    /// An error that concerns the whole robot.
    pub fn refused(&self, fault: Fault) -> GenerateError {
        GenerateError::Refused {
            file: self.shown.clone(),
            faults: vec![PlacedFault { line: 1, column: 1, fault }],
        }
    }
}

/// Reads a URDF, or expands a xacro file to one.
///
/// # Errors
/// If it cannot be read or is not a valid robot.
pub(crate) fn load(
    path: &Path,
    xacro: &XacroSettings,
    packages: &Packages,
    cancellation: &Cancellation,
) -> Result<Source, GenerateError> {
    let shown = path.display().to_string();
    let File { bytes, canonical, folder } = find(path, &shown)?;
    let mut notes = Vec::new();
    let read = read(path, &shown, &bytes, xacro, packages, cancellation, &mut notes)?;
    let names = names(&canonical);
    let text = (read.text, read.is_verbatim);
    source(shown, folder, names, bytes, text, notes)
}

/// A file on disk.
pub(crate) struct File {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Its path, and that of its folder, with symbolic links resolved.
    pub canonical: PathBuf,
    pub folder: PathBuf,
}

/// Reads a file.
///
/// # Errors
/// If it cannot be read, or is too large.
pub(crate) fn find(path: &Path, shown: &str) -> Result<File, GenerateError> {
    let unreadable = |reason: String| GenerateError::Read { file: shown.to_owned(), reason };
    let bytes = regular::read(path, MAX_SOURCE_BYTES);
    let bytes = bytes.map_err(|error| unreadable(error.to_string()))?;
    let canonical = path.canonicalize().map_err(|error| unreadable(error.to_string()))?;
    let folder = canonical.parent().map_or_else(|| PathBuf::from("."), Path::to_owned);
    Ok(File { bytes, canonical, folder })
}

/// A text before it is repaired.
pub(crate) struct Read {
    pub text: String,
    /// Whether it is an exact decoding of the bytes.
    pub is_verbatim: bool,
    /// Whether xacro made it.
    pub is_expanded: bool,
}

/// Decodes the bytes of a file, and expands them where they are macros.
///
/// # Errors
/// If it is no text, or xacro fails.
pub(crate) fn read(
    path: &Path,
    shown: &str,
    bytes: &[u8],
    xacro: &XacroSettings,
    packages: &Packages,
    cancellation: &Cancellation,
    notes: &mut Vec<Note>,
) -> Result<Read, GenerateError> {
    let (text, is_verbatim) = decode::decode(bytes, shown, notes)?;
    // The user's name for the file decides, not the target of a symbolic link.
    let is_xacro_file = path.extension().is_some_and(|extension| extension == "xacro");
    let is_expanded = is_xacro_file || (xacro.expand_urdf && text.contains("<xacro:"));
    Ok(Read {
        text: match is_expanded {
            true => xacro::expand(path, shown, xacro, packages, cancellation)?,
            false => text,
        },
        is_verbatim: is_verbatim && !is_expanded,
        is_expanded,
    })
}

/// Reads a URDF from memory, such as from a pipe. Relative names refer to `folder`.
///
/// # Errors
/// If it is not a valid robot.
pub(crate) fn load_text(
    bytes: Vec<u8>,
    shown: &str,
    folder: &Path,
) -> Result<Source, GenerateError> {
    let folder = folder.canonicalize().map_err(|error| GenerateError::Read {
        file: shown.to_owned(),
        reason: error.to_string(),
    })?;
    load_text_in(bytes, shown, folder)
}

/// As [`load_text`], in a folder that may be missing.
///
/// # Errors
/// If it is not a valid robot.
pub(crate) fn load_text_in(
    bytes: Vec<u8>,
    shown: &str,
    folder: PathBuf,
) -> Result<Source, GenerateError> {
    let shown = shown.to_owned();
    if bytes.len() as u64 > MAX_SOURCE_BYTES {
        let limit = MAX_SOURCE_BYTES >> 20;
        return Err(GenerateError::Read {
            file: shown,
            reason: format!("it is longer than {limit} MiB"),
        });
    }
    let mut notes = Vec::new();
    let (text, is_verbatim) = decode::decode(&bytes, &shown, &mut notes)?;
    let names = names(Path::new("robot.urdf"));
    source(shown, folder, names, bytes, (text, is_verbatim), notes)
}

/// `names` are the file name without its extensions, and the file name in the URDD. `is_verbatim` is true if the text is an
/// exact decoding of the bytes.
fn source(
    shown: String,
    folder: PathBuf,
    names: (String, String),
    bytes: Vec<u8>,
    (text, mut is_verbatim): (String, bool),
    mut notes: Vec<Note>,
) -> Result<Source, GenerateError> {
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

/// A robot as read by [`generate`](super::generate).
#[derive(Debug, Clone, PartialEq)]
pub struct SourceRobot {
    /// The content of its `urdf_module`.
    pub robot: UrdfModule,
    /// The URDF that a URDD stores: the input, repaired if necessary.
    pub carried: Vec<u8>,
    /// Deviations in the input.
    pub notes: Vec<Note>,
}

/// Reads a URDF from memory without generating anything. Xacro macros are not expanded.
///
/// `name` is the name of a robot without one, and stands for the file in notes and errors.
///
/// # Errors
/// If it cannot be read or is not a valid robot.
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

/// A text that matches its reading.
struct Mended {
    text: String,
    /// Whether no repair was necessary.
    is_verbatim: bool,
    reading: Reading,
    mesh_places: Vec<(u32, u32)>,
}

/// Reads a robot, and repairs its text until both match.
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
            GenerateError::Refused { file: shown.to_owned(), faults }
        };
        let reading = urdf::read(&text, name).map_err(refused)?;
        if mesh_places.is_none() {
            // Later texts are repaired; positions in them mean nothing to the user.
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
    let reason = "the repaired URDF needs repairs again";
    Err(GenerateError::internal(shown, reason))
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

/// The file name without its extensions, and the file name in the URDD.
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
