//! What somebody meant who mistyped a name.

/// The name that differs in the fewest characters, of those that differ in at most half.
pub(crate) fn nearest<'a>(names: impl Iterator<Item = &'a str>, name: &str) -> Option<String> {
    names
        .map(|known| (strsim::damerau_levenshtein(known, name), known))
        .filter(|(distance, known)| 2 * distance <= known.chars().count().max(2))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, known)| known.to_owned())
}
