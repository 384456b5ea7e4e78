//! What loops are made from.

use std::cell::Cell;
use std::ops::Range;

use crate::error::GenerateError;
use urdd_directory::cancellation::Cancellation;
use urdd_format::bounds::BoundsModule;
use urdd_format::chain::ChainModule;
use urdd_format::dof::DofModule;
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
    /// The work of closings so far.
    pub spent: Cell<u64>,
}

impl Made<'_> {
    pub fn note(&self, kind: NoteKind, problem: String, assumed: &str) -> Note {
        let file = self.source.shown.clone();
        Note { kind, file, line: 0, column: 0, problem, assumed: assumed.to_owned() }
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
