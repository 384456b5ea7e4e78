//! What loops are made from.

use std::ops::Range;

use crate::error::GenerateError;
use urdd_directory::cancellation::Cancellation;
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
use urdd_format::short::Short;
use urdd_kinematics::{ConfigurationSpace, ForwardKinematics};
use urdd_source::Source;
use urdd_source::loops::Said;
use urdd_source::note::{Note, NoteKind};

/// What loops are made from.
pub struct Made<'a> {
    pub source: &'a Source,
    pub chain: &'a ChainModule,
    pub dof: &'a DofModule,
    pub bounds: &'a BoundsModule,
    pub space: &'a ConfigurationSpace,
    pub kinematics: &'a ForwardKinematics,
    pub cancellation: &'a Cancellation,
}

impl Made<'_> {
    pub fn note(&self, kind: NoteKind, problem: String, assumed: &str) -> Note {
        let file = self.source.shown.clone();
        Note { kind, file, line: 0, column: 0, problem, assumed: assumed.to_owned() }
    }

    /// The fault of a loop or coupling: of the URDF itself, it is left out with a note; of a file beside, it is refused.
    pub fn fault(
        &self,
        said: &Said,
        (element, place): (Range<usize>, Range<usize>),
        called: &str,
        fault: String,
    ) -> Result<Note, GenerateError> {
        if said.text.is_some() {
            return Err(self.refused(said, Some(place), fault));
        }
        Ok(self.left_out(said, element, fault, called))
    }

    /// The note about a loop or coupling that is left out.
    pub fn left_out(
        &self,
        said: &Said,
        element: Range<usize>,
        problem: String,
        called: &str,
    ) -> Note {
        let assumed = format!("`{}` is left out", Short::of(called));
        let mut note = self.note(NoteKind::LeftOut, problem, &assumed);
        if let Some(place) = said.place(element.start) {
            (note.file, note.line, note.column) = (place.file.clone(), place.line, place.column);
        }
        note
    }

    pub fn refused(
        &self,
        said: &Said,
        place: Option<Range<usize>>,
        fault: String,
    ) -> GenerateError {
        said.error(place, &self.source.shown, fault).into()
    }
}
