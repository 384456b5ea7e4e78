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

/// A word, and what it says; empty where the word says it.
pub type Word = (&'static str, &'static str);

/// Declares what people choose by a word: an enum with the word of each variant, whose documentation is the help for it.
/// `what` is what an unknown word is not, with its verb.
#[macro_export]
macro_rules! words {
    ($(#[$about:meta])* pub enum $name:ident $what:literal {
        $(#[doc = $help:literal] $(#[$more:meta])* $variant:ident $word:literal,)+
    }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $name { $(#[doc = $help] $(#[$more])* $variant,)+ }

        impl $name {
            /// All of them.
            pub const ALL: &[$name] = &[$($name::$variant),+];

            /// Their words, and what each says.
            pub const WORDS: &[$crate::word::Word] = &[$(($word, $help)),+];

            /// Its word for users.
            pub fn word(self) -> &'static str {
                Self::WORDS[self as usize].0
            }
        }

        impl std::str::FromStr for $name {
            type Err = $crate::word::UnknownWord;

            fn from_str(word: &str) -> Result<Self, Self::Err> {
                $crate::word::with_word(word, Self::ALL, Self::word, $what)
            }
        }
    };
}
