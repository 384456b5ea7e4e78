//! Where a finding is, and by how much something is off there.

use urdd_directory::position::Position;

/// Where a finding is.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// File relative to the URDD's root, with forward slashes.
    pub file: Option<String>,
    /// JSON Pointer into the document.
    pub pointer: Option<String>,
    /// Line and column in the file.
    pub position: Option<Position>,
    /// What the pointer leads to, by the names of links, joints or DOFs.
    pub subject: Option<String>,
}

/// By how much something is off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Magnitude {
    /// How much; not a number where it cannot be said.
    pub value: f64,
    /// Its unit; empty for a ratio.
    pub unit: &'static str,
}

/// Another place of a folded finding.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Occurrence {
    /// Where.
    pub place: Place,
    /// What is wrong there, where that is not what the finding says.
    pub message: Option<String>,
    /// What should be there.
    pub expected: Option<String>,
    /// What is there.
    pub actual: Option<String>,
    /// By how much it is off.
    pub magnitude: Option<Magnitude>,
}

impl Occurrence {
    /// About how much memory it takes.
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
