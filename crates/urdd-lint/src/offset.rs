//! Places of a text as offsets.

use urdd_directory::position::LineIndex;

/// The byte offset of a line and column, both from 1.
pub fn offset(text: &str, lines: &LineIndex, line: usize, column: usize) -> Option<usize> {
    let start = lines.line_start(line)?;
    let rest = text.get(start..)?;
    let mut ends = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    Some(start + ends.nth(column.checked_sub(1)?)?)
}
