//! Places of a text as offsets.

use urdd_directory::position::{LineIndex, Position};

/// The byte offset of a position.
pub fn offset(text: &str, lines: &LineIndex, at: Position) -> Option<usize> {
    let start = lines.line_start(at.line as usize)?;
    let rest = text.get(start..)?;
    let mut ends = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    Some(start + ends.nth((at.column as usize).checked_sub(1)?)?)
}
