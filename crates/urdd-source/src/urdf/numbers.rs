//! Lists of numbers in attributes.

/// The result of parsing an attribute of `N` numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Numbers<const N: usize> {
    /// `N` finite numbers.
    Finite([f64; N]),
    /// `N` numbers, at least one of them infinite or NaN.
    NotFinite,
    /// Anything else.
    Wrong,
}

/// The words of an attribute as numbers; `None` if one is not a number.
pub(super) fn words(text: &str) -> Option<Vec<f64>> {
    text.split_ascii_whitespace().map(|word| word.parse().ok()).collect()
}

pub(super) fn read<const N: usize>(text: &str) -> Numbers<N> {
    match words(text).and_then(|words| <[f64; N]>::try_from(words).ok()) {
        Some(numbers) if numbers.iter().all(|x| x.is_finite()) => Numbers::Finite(numbers),
        Some(_) => Numbers::NotFinite,
        None => Numbers::Wrong,
    }
}

/// What an attribute of `count` numbers should be.
pub(super) fn what(count: usize) -> String {
    match count {
        1 => "one number".to_owned(),
        _ => format!("{count} numbers with white space between them"),
    }
}

/// The numbers of a parent's only element of a name, each in the attribute of its field's name.
macro_rules! element_of_numbers {
    ($reader:ident, $parent:expr, $element:literal, $type:ident { $($field:ident),* }) => {
        $reader.only($parent, $element).map(|element| v1::$type {
            $($field: $reader.number(element, stringify!($field)),)*
        })
    };
}

pub(super) use element_of_numbers;
