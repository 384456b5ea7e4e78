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

#[cfg(test)]
mod tests {
    use super::repeated;

    #[test]
    fn case_makes_another_name() {
        let names = ["a", "A", "", "a", "", "a"];
        let found: Vec<_> = repeated(names.into_iter()).collect();
        assert_eq!(found, [(3, 0, "a"), (4, 2, ""), (5, 0, "a")]);
    }
}
