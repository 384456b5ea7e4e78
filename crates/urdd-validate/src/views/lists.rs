//! Lists that must all have the same length, and names that occur more than once.

use std::collections::HashMap;

/// The lists that do not have the expected length. A stale module is one mistake, even if it shows in every list.
pub struct WrongLengths {
    /// Pointer of the first one.
    pub pointer: String,
    /// Length of the first one.
    pub length: usize,
    /// All of them with their lengths, for messages.
    pub in_words: String,
    /// Whether every list is wrong.
    pub are_all: bool,
}

/// Finds the lists, given by key and length, that do not have the expected length.
pub fn wrong_lengths(lists: &[(&str, usize)], expected: usize) -> Option<WrongLengths> {
    let wrong = lists.iter().filter(|(_, length)| *length != expected);
    let (first, length) = wrong.clone().next()?;
    let words: Vec<String> = wrong.map(|(key, length)| format!("`{key}` has {length}")).collect();
    Some(WrongLengths {
        pointer: format!("/{first}"),
        length: *length,
        in_words: words.join(", "),
        are_all: words.len() == lists.len(),
    })
}

/// Names that occurred before: index, index of the first occurrence, name.
pub fn repeated<'a>(
    names: impl Iterator<Item = &'a str>,
) -> impl Iterator<Item = (usize, usize, &'a str)> {
    let mut seen: HashMap<&str, usize> = HashMap::new();
    names.enumerate().filter_map(move |(index, name)| {
        let first = *seen.entry(name).or_insert(index);
        (first != index).then_some((index, first, name))
    })
}
