//! Lists of numbers in attributes.

/// What an attribute that should be `N` numbers is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Numbers<const N: usize> {
    /// That.
    Finite([f64; N]),
    /// That, but one of them is infinite, or none.
    NotFinite,
    /// Something else.
    Wrong,
}

/// The words of an attribute as numbers; `None` where one is none.
pub(super) fn words(text: &str) -> Option<Vec<f64>> {
    text.split_ascii_whitespace()
        .map(|word| word.parse().ok())
        .collect()
}

pub(super) fn read<const N: usize>(text: &str) -> Numbers<N> {
    match words(text).and_then(|words| <[f64; N]>::try_from(words).ok()) {
        Some(numbers) if numbers.iter().all(|x| x.is_finite()) => Numbers::Finite(numbers),
        Some(_) => Numbers::NotFinite,
        None => Numbers::Wrong,
    }
}

/// What a wrong attribute is, in words.
pub(super) fn what(count: usize) -> String {
    match count {
        1 => "one number".to_owned(),
        _ => format!("{count} numbers with white space between them"),
    }
}
