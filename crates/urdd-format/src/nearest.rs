//! Suggestions for mistyped names.

/// Longest name to compare, in bytes: the cost in memory and time is the product of the lengths.
const MAX_BYTES: usize = 100;

/// The name with the smallest edit distance, at most half its characters. `None` for names over 100 bytes.
pub fn nearest<'a>(names: impl Iterator<Item = &'a str>, name: &str) -> Option<String> {
    if name.len() > MAX_BYTES {
        return None;
    }
    names
        .filter(|known| known.len() <= MAX_BYTES)
        .map(|known| (strsim::damerau_levenshtein(known, name), known))
        .filter(|(distance, known)| 2 * distance <= known.chars().count().max(2))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, known)| known.to_owned())
}
