//! An open document.

use std::sync::Arc;
use std::time::Instant;

use crate::analysis::Analysis;
use crate::diagnostics::Found;
use crate::document::Snapshot;
use crate::kept::kept;
use urdd_directory::cancellation::Cancellation;

pub struct Document {
    pub snapshot: Arc<Snapshot>,
    /// When its findings are to be computed.
    pub due: Option<Instant>,
    /// The findings of the current text, once computed.
    pub of_text: Option<Analysis>,
    /// The last findings about files, with the version that they are about.
    pub of_files: Option<(Arc<Snapshot>, Analysis)>,
    /// Ends what is being computed.
    pub cancellation: Cancellation,
}

impl Document {
    /// Takes in the next version, whose findings are computed at `due`.
    pub fn replace(&mut self, next: Snapshot, due: Instant) {
        self.snapshot = Arc::new(next);
        self.due = Some(due);
        self.of_text = None;
        self.cancellation.cancel();
        self.cancellation = Cancellation::default();
    }

    /// The newest analysis of the current version: that of its files, else that of its text.
    pub fn analysis(&self) -> Option<&Analysis> {
        let of_files = self.of_files.as_ref();
        let of_files = of_files.filter(|(snapshot, _)| Arc::ptr_eq(snapshot, &self.snapshot));
        of_files.map(|(_, analysis)| analysis).or(self.of_text.as_ref())
    }

    /// The findings of the current version: those about files, if they are of this version; else those of the text, and
    /// what still stands of the last ones about files.
    pub fn findings(&self) -> Vec<Found> {
        if let Some((snapshot, analysis)) = &self.of_files
            && Arc::ptr_eq(snapshot, &self.snapshot)
        {
            return analysis.found.clone();
        }
        let Some(of_text) = &self.of_text else {
            return Vec::new();
        };
        let mut found = of_text.found.clone();
        if let Some((snapshot, analysis)) = &self.of_files {
            found.extend(kept((snapshot, analysis), &self.snapshot, &of_text.postponed));
        }
        found
    }
}
