//! What somebody meant who mistyped a name.

/// Longest name that is compared, bytes: comparing takes memory and time with the product of the lengths.
const MAX_BYTES: usize = 100;

/// The name that differs in the fewest characters, of those that differ in at most half. Long names have none.
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
