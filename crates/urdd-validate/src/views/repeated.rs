//! Names that occur more than once.

use std::collections::HashMap;

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
