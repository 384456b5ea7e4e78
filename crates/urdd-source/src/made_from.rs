//! Where places of a text are in the user's files.

use std::path::Path;

use super::fault::{Fault, PlacedFault};
use super::note::SourcePlace;
use super::watch::Trail;
use super::written::WrittenMap;
use urdd_directory::position::{LineIndex, Position};

/// What a text was made from.
pub struct Origin<'a> {
    /// The file, as the user named it.
    pub shown: &'a str,
    /// Number of lines that are missing at the beginning.
    pub first_line: u32,
    /// Where xacro has its elements from.
    pub trail: Option<&'a Trail>,
    /// The file.
    pub path: &'a Path,
}

impl Origin<'_> {
    /// Where offsets of the text are in the user's files.
    pub fn offsets(&self, text: &str, offsets: impl Iterator<Item = usize>) -> Vec<SourcePlace> {
        let lines = LineIndex::new(text);
        self.places(text, offsets.map(|offset| lines.position(offset)).collect())
    }

    /// Where places of the text are in the user's files: lines of an expansion are in none.
    fn places(&self, text: &str, places: Vec<Position>) -> Vec<SourcePlace> {
        let Some(trail) = self.trail.filter(|_| !places.is_empty()) else {
            let line = |at: Position| if at.line == 0 { 0 } else { at.line + self.first_line };
            let place = |at: Position| SourcePlace {
                file: self.shown.to_owned(),
                line: line(at),
                column: at.column,
            };
            return places.into_iter().map(place).collect();
        };
        let found = WrittenMap::new(text, trail, self.path).find(places.iter().copied());
        let place = |at: Position| match found.get(&at) {
            Some(written) => SourcePlace {
                file: written.named(self.shown),
                line: written.at.line,
                column: written.at.column,
            },
            None => SourcePlace { file: self.shown.to_owned(), line: 0, column: 0 },
        };
        places.into_iter().map(place).collect()
    }

    /// Faults, each where it is in the user's files.
    pub fn faults(&self, text: &str, mut faults: Vec<PlacedFault>) -> Vec<PlacedFault> {
        let places = faults.iter().map(|one| Position { line: one.line, column: one.column });
        let places = self.places(text, places.collect());
        for (placed, SourcePlace { file, line, column }) in faults.iter_mut().zip(places) {
            placed.file = Some(file).filter(|file| file != self.shown);
            (placed.line, placed.column) = (line, column);
            if let Fault::TwoLinks { first, .. } | Fault::TwoJoints { first, .. } =
                &mut placed.fault
                && *first > 0
            {
                *first = if self.trail.is_some() { 0 } else { *first + self.first_line };
            }
        }
        faults
    }
}
