//! Names in columns.

use urdd_format::escape;

/// A name on one line.
pub(super) fn safe(text: &str) -> String {
    escape::line(text).into_owned()
}

/// The width of the longest of these names, in characters.
pub(super) fn widest<'a>(names: impl Iterator<Item = &'a String>) -> usize {
    let widths = names.map(|name| safe(name).chars().count());
    widths.max().unwrap_or(0)
}
