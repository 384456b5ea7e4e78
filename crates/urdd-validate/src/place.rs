//! The place of a finding, and the size of a difference.

use urdd_directory::position::Position;

/// The place of a finding.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// File relative to the URDD's root, with forward slashes.
    pub file: Option<String>,
    /// JSON Pointer into the document.
    pub pointer: Option<String>,
    /// Line and column in the file.
    pub position: Option<Position>,
    /// The target of the pointer, by names of links, joints or DOFs.
    pub subject: Option<String>,
}

/// The size of a difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Magnitude {
    /// Its value; NaN if it is unknown.
    pub value: f64,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
}

/// A further place of a folded finding.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Occurrence {
    /// The place.
    pub place: Place,
    /// What is wrong there, if it differs from the finding's message.
    pub message: Option<String>,
    /// The expected value.
    pub expected: Option<String>,
    /// The actual value.
    pub actual: Option<String>,
    /// The size of the difference.
    pub magnitude: Option<Magnitude>,
}

impl Occurrence {
    /// Approximate memory that it takes.
    pub fn bytes(&self) -> usize {
        let texts = [
            &self.place.file,
            &self.place.pointer,
            &self.place.subject,
            &self.message,
            &self.expected,
            &self.actual,
        ];
        let texts = texts.into_iter().flatten().map(String::len);
        size_of::<Occurrence>() + texts.sum::<usize>()
    }
}
