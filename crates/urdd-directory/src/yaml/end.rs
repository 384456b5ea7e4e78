//! The end of a YAML file without a final line break.

use saphyr_parser::{ScalarStyle, Span};

use super::super::position::{Position, position};

/// Message for a scalar at such an end.
pub const DISPUTED: &str =
    "readers disagree about the end of this text, since its last line has no line break: add one";

/// The end of a text.
pub struct End<'y> {
    text: &'y str,
    /// Number of characters, if the final line break is missing.
    open: Option<usize>,
}

impl<'y> End<'y> {
    /// Finds the end.
    pub fn new(text: &'y str) -> Self {
        let is_open = !text.ends_with(['\n', '\r']);
        Self { text, open: is_open.then(|| text.chars().count()) }
    }

    /// Whether a block scalar ends at the end of the file without a line break. Some readers add one.
    pub fn is_disputed(&self, scalar: &str, style: ScalarStyle, span: Span) -> bool {
        matches!(style, ScalarStyle::Literal | ScalarStyle::Folded)
            && scalar.ends_with('\n')
            && self.open.is_some_and(|count| span.end.index() >= count)
    }

    /// Limits a position to the end of the text: the parser assumes a final line break, and may report a line that does
    /// not exist.
    pub fn at_most(&self, at: Position) -> Position {
        at.min(position(self.text, self.text.len()))
    }
}
