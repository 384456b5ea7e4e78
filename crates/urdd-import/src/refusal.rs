//! A fault and its place, on its way to the reader's caller.

use super::fault::ImportFault;
use super::place::{Place, TextFile};
use urdd_directory::position::LineIndex;

/// A fault, and where it is.
#[derive(Debug)]
pub struct Refusal {
    pub place: Place,
    pub fault: ImportFault,
}

/// What fails with a place.
pub type Fallible<T> = Result<T, Refusal>;

/// A fault at a place.
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

/// A fault, and its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Placed {
    /// The file, as the user would name it.
    pub file: String,
    /// Line in it, from 1.
    pub line: u32,
    /// Column in the line, from 1, in characters.
    pub column: u32,
    /// What is wrong.
    pub fault: ImportFault,
}

/// A fault in one of the files.
pub fn placed(files: &[TextFile], Refusal { place, fault }: Refusal) -> Placed {
    let file = files.get(place.file).map_or(&[][..], std::slice::from_ref);
    let there = Positions::of(file).at(Place { file: 0, ..place });
    let (file, line, column) = there.unwrap_or_default();
    Placed { file: file.to_owned(), line, column, fault }
}

/// The lines of files, for places in them.
pub struct Positions<'f>(Vec<(&'f str, Option<LineIndex<'f>>)>);

impl<'f> Positions<'f> {
    /// Finds the lines.
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
