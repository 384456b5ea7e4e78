//! What a check says of findings that follow from others.

use super::code::Code;
use urdd_directory::position::Position;

/// A finding of a rule that goes away when the fault of another one is mended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Effect {
    /// Where it is.
    pub at: Position,
    /// What it says.
    pub message: String,
    /// The finding that it follows from: its rule, and where it is.
    pub cause: (Code, Position),
}
