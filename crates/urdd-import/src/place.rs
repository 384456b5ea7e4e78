//! Places in the files of a description, and faults at them.

use std::path::PathBuf;
use std::sync::Arc;

use urdd_directory::position::LineIndex;
use urdd_source::gate::Gate;
use urdd_source::{FoundMesh, MAX_SOURCE_BYTES, SourceError, decode};

use crate::fault::{ImportFault, Unreachable};

/// What a file costs, bytes, and each byte of its text: bytes, text, document and elements.
const FILE: usize = 20_000;
const TEXT: usize = 16;

/// A place in one of the files of a description.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The index of the file in the list of files.
    pub file: usize,
    /// The byte offset in its text.
    pub offset: usize,
}

/// A text file that a description was read from.
#[derive(Debug, Clone)]
pub struct TextFile {
    /// The file, as the user would name it.
    pub shown: String,
    /// Its path, with symbolic links resolved.
    pub path: PathBuf,
    pub text: String,
    pub bytes: Arc<[u8]>,
}

impl TextFile {
    /// A file that was read.
    ///
    /// # Errors
    /// If it is not text.
    pub fn new(shown: String, path: PathBuf, bytes: Vec<u8>) -> Result<Self, SourceError> {
        let text = decode(&bytes, &shown, &mut Vec::new())?.text;
        Ok(TextFile { shown, path, text, bytes: bytes.into() })
    }

    /// A file that may not be text; then its text is empty.
    pub fn any(shown: String, path: PathBuf, bytes: Arc<[u8]>) -> Self {
        let text = std::str::from_utf8(&bytes).unwrap_or_default().to_owned();
        TextFile { shown, path, text, bytes }
    }

    /// As [`TextFile::new`], of a file that a description includes. What is made of it is charged each time it is
    /// included.
    ///
    /// # Errors
    /// If it cannot be read, is not text, or the account of the gate does not have its cost.
    pub fn included(gate: &Gate, found: &FoundMesh) -> Result<Self, ImportFault> {
        let shown = found.file.display().to_string();
        let bytes = gate.bytes(found, MAX_SOURCE_BYTES);
        let bytes = bytes.map_err(|why| ImportFault::File(Unreachable::unread(&shown, &why)))?;
        gate.account().charge(FILE + bytes.len() * TEXT)?;
        TextFile::new(shown.clone(), found.file.clone(), bytes).map_err(|error| {
            let reason = error.to_string();
            ImportFault::File(Unreachable::Unreadable { file: shown, reason })
        })
    }
}

#[derive(Debug)]
pub struct Refusal {
    pub place: Place,
    pub fault: ImportFault,
}

/// What fails with a place.
pub type Fallible<T> = Result<T, Refusal>;

pub fn at(place: Place, fault: impl Into<ImportFault>) -> Refusal {
    Refusal { place, fault: fault.into() }
}

/// What fails without a place, and is given one.
pub trait Placing<T> {
    /// Its fault at a place.
    fn at(self, place: Place) -> Fallible<T>;
}

impl<T, E: Into<ImportFault>> Placing<T> for Result<T, E> {
    fn at(self, place: Place) -> Fallible<T> {
        self.map_err(|fault| at(place, fault))
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Placed {
    /// The file, as the user would name it.
    pub file: String,
    /// Line in it, from 1.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    pub fault: ImportFault,
}

pub fn placed(files: &[TextFile], Refusal { place, fault }: Refusal) -> Placed {
    let file = files.get(place.file).map_or(&[][..], std::slice::from_ref);
    let there = Positions::of(file).at(Place { file: 0, ..place });
    let (file, line, column) = there.unwrap_or_default();
    Placed { file: file.to_owned(), line, column, fault }
}

/// The lines of files, for places in them.
pub struct Positions<'f>(Vec<(&'f str, Option<LineIndex<'f>>)>);

impl<'f> Positions<'f> {
    pub fn of(files: &'f [TextFile]) -> Self {
        let lines =
            |file: &'f TextFile| (!file.text.is_empty()).then(|| LineIndex::new(&file.text));
        Positions(files.iter().map(|file| (&*file.shown, lines(file))).collect())
    }

    /// The file, line and column of a place.
    pub fn at(&self, place: Place) -> Option<(&'f str, u32, u32)> {
        let (shown, lines) = self.0.get(place.file)?;
        // A binary file has no lines.
        let Some(lines) = lines else { return Some((shown, 0, 0)) };
        let at = lines.position(place.offset);
        Some((shown, at.line, at.column))
    }
}
