//! The end of a YAML file whose last line does not end.

use saphyr_parser::{ScalarStyle, Span};

use super::super::position::{Position, position};

/// What is wrong with a text that ends there, and what to do.
pub const DISPUTED: &str = "readers disagree about the end of this text, since the file's last line does not end: end it with a line break";

/// The end of a text.
pub struct End<'y> {
    text: &'y str,
    /// How many characters there are, where the last line does not end.
    open: Option<usize>,
}

impl<'y> End<'y> {
    /// Finds it.
    pub fn new(text: &'y str) -> Self {
        let is_open = !text.ends_with(['\n', '\r']);
        Self {
            text,
            open: is_open.then(|| text.chars().count()),
        }
    }

    /// Whether a scalar in block style ends here, without a line break: to some readers it has one
    /// all the same.
    pub fn is_disputed(&self, scalar: &str, style: ScalarStyle, span: Span) -> bool {
        matches!(style, ScalarStyle::Literal | ScalarStyle::Folded)
            && scalar.ends_with('\n')
            && self.open.is_some_and(|count| span.end.index() >= count)
    }

    /// The place, or the end: the parser believes that every line ends, and goes on to one that is
    /// not there.
    pub fn at_most(&self, at: Position) -> Position {
        at.min(position(self.text, self.text.len()))
    }
}
