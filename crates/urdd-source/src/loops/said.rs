//! What a file says of loops.

use std::collections::HashMap;
use std::ops::Range;

use urdd_directory::loops_toml::File;
use urdd_directory::position::position;
use urdd_format::short::Short;

use crate::error::SourceError;
use crate::note::{Note, NoteKind, SourcePlace};

/// What a file says of loops.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Said {
    /// The loops.
    pub file: File,
    /// Joints that the source itself says move freely, where others move freely because it says nothing of them, by name.
    pub first: Vec<String>,
    /// Where the elements of the URDF are in the user's files, by their byte offset. Empty if another file says it.
    pub places: HashMap<usize, SourcePlace>,
    /// Joints that have another type than the URDF says, by name.
    pub retyped: Vec<(String, Retyped)>,
    /// The file, as it is shown, and its text. `None` if the URDF itself says it.
    pub text: Option<(String, String)>,
    /// What else says loops and is passed over.
    pub notes: Vec<Note>,
}

impl Said {
    /// The note about another file that says loops, too.
    pub fn passed_over(&self, other: &str) -> Note {
        let used = self.text.as_ref().map_or("the URDF", |(file, _)| file);
        let used = Short::of(used);
        Note::of_file(
            other,
            NoteKind::LeftOut,
            format!("this file says loops, and so does `{used}`"),
            format!("the loops of this file are passed over, those of `{used}` are used"),
        )
    }

    /// The note about a joint that is to be another, and that the URDF does not have.
    pub fn missing(&self, joint: &str, urdf: &str) -> Note {
        let joint = Short::of(joint);
        Note::of_file(
            self.text.as_ref().map_or(urdf, |(file, _)| file),
            NoteKind::LeftOut,
            format!("the URDF has no joint `{joint}`, which is to be another"),
            "the name is passed over",
        )
    }

    /// Where its loops and couplings begin, byte offsets.
    pub fn offsets(&self) -> impl Iterator<Item = usize> {
        let loops = self.file.loops.iter().map(|one| one.span().start);
        loops.chain(self.file.couplings.iter().map(|one| one.span().start))
    }

    /// Where an element of the URDF is, if the URDF says it.
    pub fn place(&self, offset: usize) -> Option<&SourcePlace> {
        self.places.get(&offset)
    }

    /// The error about a place of the file, if it is known.
    pub fn error(&self, place: Option<Range<usize>>, urdf: &str, fault: String) -> SourceError {
        let (file, at) = match &self.text {
            Some((file, text)) => (file.clone(), place.map(|place| position(text, place.start))),
            None => (urdf.to_owned(), None),
        };
        let (line, column) = at.map_or((1, 1), |at| (at.line, at.column));
        SourceError::Import { file, line, column, fault }
    }
}

/// What a joint is to be instead of what the URDF says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Retyped {
    /// A ball.
    Spherical,
    /// Fixed.
    Fixed,
    /// Two hinges one after the other, about axes of the joint's frame.
    Universal([char; 2]),
}
