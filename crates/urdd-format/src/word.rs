//! Words of a list, as people write them.

use thiserror::Error;

/// A word that is none of a list.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there {what} `{}`; there are: {}", .word.escape_debug(), .known.join(", "))]
pub struct UnknownWord {
    /// What there is none of, with its verb.
    what: &'static str,
    word: String,
    known: Vec<&'static str>,
}

/// The one of these with a word; `what` is what there is none of, with its verb.
///
/// # Errors
/// If none has it.
pub fn with_word<T: Copy>(
    word: &str,
    all: &[T],
    word_of: fn(T) -> &'static str,
    what: &'static str,
) -> Result<T, UnknownWord> {
    let found = all.iter().copied().find(|one| word_of(*one) == word);
    found.ok_or_else(|| {
        let known = all.iter().map(|one| word_of(*one)).collect();
        UnknownWord { what, word: word.to_owned(), known }
    })
}
