//! What a check says of findings that follow from others.

use super::code::Code;

/// A line and a column.
pub type At = (usize, usize);

/// A finding of a rule that goes away when the fault of another one is mended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effect {
    /// Where it is.
    pub at: At,
    /// What it says.
    pub message: String,
    /// The finding that it follows from: its rule, and where it is.
    pub cause: (Code, At),
}
