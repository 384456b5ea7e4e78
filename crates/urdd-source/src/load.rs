//! Reads the source file: yields the robot and the text that the URDD stores.

use std::path::{Path, PathBuf};

use urdd_directory::account::{Account, AccountError};
use urdd_directory::file_type::{self, FileType};
use urdd_directory::path;
use urdd_format::urdf::UrdfModule;
use urdd_xml::Xml;
use urdd_xml::element::apply;

use crate::arguments::needed;
use crate::decode::{Decoded, Decoding, Original, Repaired, decode, mend_xml};
use crate::error::SourceError;
use crate::fault::{Fault, PlacedFault};
use crate::files::{Files, MAX_SOURCE_BYTES};
use crate::loops::{self, CostlyElement, Said};
use crate::note::{Note, Remark, SourcePlace};
use crate::settings::Settings;
use crate::suggested::deciding;
use crate::trail::Trail;
use crate::unused_arguments::unused_arguments;
use crate::urdf::{self, Reading};
use crate::written::Origin;
use crate::xacro;

/// Maximum number of repair rounds; one is enough unless this program has a bug.
const MOST_ROUNDS: usize = 4;

/// A source after reading.
#[derive(Debug)]
pub struct Source {
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
    /// Where each mesh in `reading.mesh_offsets` is.
    pub mesh_places: Vec<SourcePlace>,
    /// What is said of the robot's loops.
    pub loops: Option<Said>,
}

impl Source {
    /// An error that concerns the whole robot.
    pub fn refused(&self, fault: Fault) -> SourceError {
        SourceError::Refused {
            file: self.shown.clone(),
            faults: vec![PlacedFault { file: None, line: 1, column: 1, fault }],
        }
    }
}

/// Reads a URDF, or expands a xacro file to one.
///
/// # Errors
/// If it cannot be read or is not a valid robot.
pub fn load(path: &Path, settings: &Settings) -> Result<Source, SourceError> {
    Ok(load_with(path, settings, |_, _| ())?.0)
}

/// As [`load`]; `also` reads the text that a URDD carries, too. It is given whether that is the file as it was found.
///
/// # Errors
/// Like [`load`].
pub fn load_with<T>(
    path: &Path,
    settings: &Settings,
    also: impl FnOnce(&Xml<'_>, bool) -> T,
) -> Result<(Source, T), SourceError> {
    let mut notes = Vec::new();
    let read = read(path, settings, &mut notes)?;
    let said = loops::beside(path, settings)?;
    with_loops(read, said, settings, notes, also)
}

/// The robot of a text, with what a file beside it says of its loops.
fn with_loops<T>(
    mut read: Read,
    said: Option<Said>,
    settings: &Settings,
    mut notes: Vec<Note>,
    also: impl FnOnce(&Xml<'_>, bool) -> T,
) -> Result<(Source, T), SourceError> {
    if let Some(said) = said.as_ref().filter(|said| !said.retyped.is_empty()) {
        let (text, missing) = loops::retyped(&Xml::new(&read.text), &said.retyped);
        notes.extend(missing.iter().map(|joint| said.missing(joint, &read.shown)));
        read.is_verbatim &= text == read.text;
        read.text = text;
    }
    let account = Account::new(&settings.cancellation);
    account.deposit(read.bytes.len());
    let (mut source, also) = mend(&Xml::new(&read.text), (&read, &account), notes, also)?;
    let Some(said) = said else { return Ok((source, also)) };
    source.notes.extend(said.notes.iter().cloned());
    // A file that is named in the settings is chosen by a person.
    if source.loops.is_some() && settings.loops.is_none() {
        source.notes.push(said.passed_over(&read.shown));
    }
    source.loops = Some(said);
    Ok((source, also))
}

/// The text of a description as an author sees it.
#[derive(Debug, Clone)]
pub struct SourceText {
    /// The text: of the file, or what xacro made of it. Nothing is repaired.
    pub text: String,
    /// Where xacro has its elements from, if it was expanded.
    pub trail: Option<Trail>,
    /// The folder that relative names refer to, with symbolic links resolved.
    pub folder: PathBuf,
    /// The file, where its bytes are not those of the text: another encoding, or a byte order mark.
    pub original: Option<Original>,
}

impl SourceText {
    /// The bytes that other programs read.
    pub fn bytes(&self) -> &[u8] {
        self.original.as_ref().map_or(self.text.as_bytes(), |original| &original.bytes)
    }
}

/// Reads the text of a URDF, or expands a xacro file to one.
///
/// # Errors
/// If it cannot be read or expanded.
pub fn read_source(path: &Path, settings: &Settings) -> Result<SourceText, SourceError> {
    let read = read(path, settings, &mut Vec::new())?;
    let is_same = read.trail.is_some() || read.bytes == read.text.as_bytes();
    Ok(SourceText {
        original: (!is_same).then_some(Original { bytes: read.bytes, decoding: read.decoding }),
        text: read.text,
        trail: read.trail,
        folder: read.folder,
    })
}

/// A description before it is repaired.
struct Read {
    shown: String,
    bytes: Vec<u8>,
    /// The file's name without its extensions: the name of a robot without one.
    stem: String,
    /// The path of its folder, with symbolic links resolved.
    folder: PathBuf,
    text: String,
    /// Whether the text is an exact decoding of the bytes.
    is_verbatim: bool,
    decoding: Decoding,
    /// Where xacro has its elements from, if it made it, and the file.
    trail: Option<Trail>,
    path: PathBuf,
}

/// Decodes the bytes of a file, and expands them where they are macros.
fn read(path: &Path, settings: &Settings, notes: &mut Vec<Note>) -> Result<Read, SourceError> {
    let shown = path.display().to_string();
    let bytes = settings.files.read(path, MAX_SOURCE_BYTES);
    let bytes = bytes.map_err(|why| SourceError::unread(&shown, why))?;
    let canonical = settings.files.canonicalize(path);
    let canonical = canonical.map_err(|why| SourceError::unread(&shown, why))?;
    let folder = canonical.parent().map_or_else(|| PathBuf::from("."), Path::to_owned);
    let Decoded { text, is_verbatim, decoding } = decode(&bytes, &shown, notes)?;
    // The user's name for the file decides, not the target of a symbolic link.
    let is_xacro_file = FileType::Xacro.is_of(path);
    let is_expanded = is_xacro_file || (settings.xacro.expand_urdf && text.contains("<xacro:"));
    let (text, trail) = match (is_expanded, &settings.files) {
        (true, Files::Disk) => {
            let (xacro, packages) = (&settings.xacro, &settings.packages);
            let expanded = xacro::expand(path, &shown, xacro, packages, &settings.cancellation);
            let (text, trail) = expanded.map_err(|error| explained(error, path, settings))?;
            let declared = settings.xacro.arguments.iter().take(settings.xacro.declared);
            let unused = unused_arguments(&canonical, &trail, declared);
            if !unused.is_empty() {
                return Err(SourceError::UnusedArguments { file: shown, unused });
            }
            (text, Some(trail))
        }
        (true, Files::Memory(_)) => {
            return Err(explained(SourceError::NoXacro { file: shown }, path, settings));
        }
        (false, _) => (text, None),
    };
    let (stem, is_verbatim) = (stem(&canonical), is_verbatim && !is_expanded);
    Ok(Read { text, is_verbatim, decoding, trail, shown, bytes, stem, folder, path: canonical })
}

/// An error of xacro, which says what is missing where arguments are.
fn explained(error: SourceError, path: &Path, settings: &Settings) -> SourceError {
    let (file, fault) = match &error {
        SourceError::Xacro { file, fault } => {
            let mut said = fault.clone();
            said.reason = format!("xacro says: {}", fault.reason);
            (file.clone(), said)
        }
        SourceError::NoXacro { file } => (file.clone(), error.to_string().into()),
        _ => return error,
    };
    let text = settings.files.read(path, MAX_SOURCE_BYTES).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let mut needed = needed(path, settings);
    if needed.is_empty()
        && let Some(property) = fault.undefined()
    {
        needed = deciding(&text, property, settings);
    }
    // With other values another package could be looked for, but not where the file names this one.
    let names = |package: &String| {
        let is_of = |default: &String| !default.is_empty() && package.contains(default);
        let is_named = || text.contains(&format!("$(find {package})"));
        needed.iter().any(|argument| argument.default.as_ref().is_none_or(is_of)) && !is_named()
    };
    match fault.package.as_ref().is_some_and(|package| !names(package)) {
        false if !needed.is_empty() => SourceError::NeedsArguments { file, needed, fault },
        _ => error,
    }
}

/// Reads a URDF from memory, such as from a pipe. Relative names refer to `folder`. Of its loops only a file tells that the
/// settings name.
///
/// # Errors
/// If it is not a valid robot.
pub fn load_text(
    bytes: Vec<u8>,
    shown: &str,
    folder: &Path,
    settings: &Settings,
) -> Result<Source, SourceError> {
    let folder = settings.files.canonicalize(folder);
    let folder = folder.map_err(|why| SourceError::unread(shown, why))?;
    let mut notes = Vec::new();
    let read = held(within_limit(bytes, shown)?, shown, folder, "robot", &mut notes)?;
    Ok(with_loops(read, loops::named(settings)?, settings, notes, |_, _| ())?.0)
}

/// As [`load_text`], of a text that others read too, in a folder that may be missing.
///
/// # Errors
/// If it is not a valid robot.
pub fn load_xml(xml: &Xml<'_>, shown: &str, folder: PathBuf) -> Result<Source, SourceError> {
    in_memory(within_limit(xml.text().into(), shown)?, shown, folder, "robot", Some(xml))
}

fn within_limit(bytes: Vec<u8>, shown: &str) -> Result<Vec<u8>, SourceError> {
    if bytes.len() as u64 <= MAX_SOURCE_BYTES {
        return Ok(bytes);
    }
    let limit = MAX_SOURCE_BYTES >> 20;
    Err(SourceError::unread(shown, format!("it is longer than {limit} MiB")))
}

/// `known` is what may be the text of these bytes, which others read too.
fn in_memory(
    bytes: Vec<u8>,
    shown: &str,
    folder: PathBuf,
    stem: &str,
    known: Option<&Xml<'_>>,
) -> Result<Source, SourceError> {
    let mut notes = Vec::new();
    let read = held(bytes, shown, folder, stem, &mut notes)?;
    let account = Account::default();
    account.deposit(read.bytes.len());
    let loaded = match known.filter(|known| known.text() == read.text) {
        Some(xml) => mend(xml, (&read, &account), notes, |_, _| ()),
        None => mend(&Xml::new(&read.text), (&read, &account), notes, |_, _| ()),
    };
    Ok(loaded?.0)
}

fn held(
    bytes: Vec<u8>,
    shown: &str,
    folder: PathBuf,
    stem: &str,
    notes: &mut Vec<Note>,
) -> Result<Read, SourceError> {
    let Decoded { text, is_verbatim, decoding } = decode(&bytes, shown, notes)?;
    let (shown, stem, path) = (shown.to_owned(), stem.to_owned(), PathBuf::new());
    Ok(Read { shown, bytes, stem, folder, text, is_verbatim, decoding, trail: None, path })
}

/// A robot, read from memory.
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
pub fn read_urdf(bytes: &[u8], name: &str) -> Result<SourceRobot, SourceError> {
    let source = in_memory(bytes.to_owned(), name, PathBuf::new(), name, None)?;
    Ok(SourceRobot { robot: source.reading.robot, carried: source.carried, notes: source.notes })
}

/// Reads a robot, and repairs its text until both match.
fn mend<T>(
    found: &Xml<'_>,
    (read, account): (&Read, &Account),
    mut notes: Vec<Note>,
    also: impl FnOnce(&Xml<'_>, bool) -> T,
) -> Result<(Source, T), SourceError> {
    let Read { shown, bytes, stem, trail, path, .. } = read;
    let Repaired { text: mut repaired, remarks, first_line, .. } = mend_xml(found);
    let mut is_verbatim = read.is_verbatim && remarks.is_empty();
    let origin = Origin { shown, first_line, trail: trail.as_ref(), path };
    let offsets = remarks.iter().map(|remark| remark.offset);
    let places = origin.offsets(repaired.as_deref().unwrap_or(found.text()), offsets);
    notes.extend(noted(&remarks, places));

    let mut mesh_places = None;
    for _ in 0..MOST_ROUNDS {
        let again = repaired.as_deref().map(Xml::new);
        let xml = again.as_ref().unwrap_or(found);
        let refused = |faults| SourceError::Refused {
            file: shown.clone(),
            faults: origin.faults(xml.text(), faults),
        };
        let mut reading = urdf::read(xml, stem).map_err(refused)?;
        // Later texts are repaired; positions in them mean nothing to the user.
        let places = mesh_places.get_or_insert_with(|| {
            let remarks = reading.remarks.iter().map(|remark| remark.offset);
            let all = remarks.chain(reading.mesh_offsets.iter().copied());
            let mut places = origin.offsets(xml.text(), all);
            let meshes = places.split_off(reading.remarks.len());
            notes.extend(noted(&reading.remarks, places));
            meshes
        });
        if !reading.edits.is_empty() {
            is_verbatim = false;
            repaired = Some(apply(xml.text(), std::mem::take(&mut reading.edits)));
            continue;
        }
        let places_of = |offsets: Vec<usize>| match repaired {
            None => origin.offsets(xml.text(), offsets.into_iter()),
            Some(_) => {
                let unknown = SourcePlace { file: shown.clone(), line: 0, column: 0 };
                vec![unknown; offsets.len()]
            }
        };
        let plus = match xml.document() {
            Ok(document) => {
                let robot = document.root_element();
                let plus = loops::placed_urdf_plus(robot, places_of, &mut notes, account);
                plus.map_err(|CostlyElement { offset, error }| match error {
                    AccountError::Cancelled(cancelled) => cancelled.into(),
                    AccountError::Overdrawn(error) => {
                        let place = places_of(vec![offset]).pop();
                        let (line, column) =
                            place.as_ref().map_or((1, 1), |at| (at.line, at.column));
                        let file = place.map_or_else(|| shown.clone(), |at| at.file);
                        SourceError::Import { file, line, column, fault: error.to_string() }
                    }
                })?
            }
            Err(_) => None,
        };
        let also = also(xml, is_verbatim);
        let source = Source {
            folder: read.folder.clone(),
            file_name: file_name(stem),
            carried: if is_verbatim { bytes.clone() } else { xml.text().into() },
            found: (!is_verbatim).then(|| bytes.clone()),
            reading,
            notes,
            mesh_places: std::mem::take(places),
            loops: plus,
            shown: shown.clone(),
        };
        return Ok((source, also));
    }
    let reason = "the repaired URDF needs repairs again".to_owned();
    Err(SourceError::Internal { file: shown.clone(), reason })
}

fn noted(remarks: &[Remark], places: Vec<SourcePlace>) -> impl Iterator<Item = Note> {
    remarks.iter().zip(places).map(|(remark, place)| {
        Note::at(place, remark.kind, remark.problem.clone(), remark.assumed.clone())
    })
}

/// The file name without its extensions, or `robot`.
pub fn stem(path: &Path) -> String {
    match file_type::stem(path) {
        stem if stem.is_empty() => "robot".to_owned(),
        stem => stem,
    }
}

/// The name of a robot's file in its URDD.
pub fn file_name(stem: &str) -> String {
    path::file_name(if stem.is_empty() { "robot" } else { stem }, ".urdf")
}
