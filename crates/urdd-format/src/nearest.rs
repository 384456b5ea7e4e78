//! Suggestions for mistyped names.

/// Longest name to compare, in bytes: the cost in memory and time is the product of the lengths.
const MAX_BYTES: usize = 100;

/// Words that tell parts of a robot apart, as numbers do.
const SIDES: [&str; 20] = [
    "l", "left", "r", "right", "front", "f", "rear", "back", "b", "upper", "lower", "top",
    "bottom", "inner", "outer", "fl", "fr", "rl", "rr", "middle",
];

/// The name with the smallest edit distance, at most half its characters; of several, the one that keeps more of the name.
/// `None` for names over 100 bytes.
pub fn nearest<'a>(names: impl Iterator<Item = &'a str>, name: &str) -> Option<String> {
    if name.len() > MAX_BYTES {
        return None;
    }
    names
        .filter(|known| known.len() <= MAX_BYTES)
        .map(|known| (closeness(known, name), known))
        .filter(|(found, known)| 2 * found.edits <= known.chars().count().max(2))
        .min_by_key(|(found, _)| *found)
        .map(|(_, known)| known.to_owned())
}

/// How near a known name is to another one: the least is the nearest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Closeness {
    /// The number of letters to add, remove, replace or swap, in any case (Damerau-Levenshtein).
    pub edits: usize,
    /// Whether it is of another side, or has other numbers: `L_link2` of `R_link2`.
    pub is_of_another_part: bool,
    /// The bytes that are not the same at the beginning and the end.
    changed: usize,
}

/// How near a known name is to another one.
pub fn closeness(known: &str, name: &str) -> Closeness {
    let same =
        |pairs: &mut dyn Iterator<Item = (u8, u8)>| pairs.take_while(|(a, b)| a == b).count();
    let (a, b) = (known.bytes(), name.bytes());
    let kept = same(&mut a.clone().zip(b.clone())) + same(&mut a.rev().zip(b.rev()));
    let (lower, name) = (known.to_lowercase(), name.to_lowercase());
    Closeness {
        edits: strsim::osa_distance(&lower, &name),
        is_of_another_part: is_of_another_part(&lower, &name),
        changed: (lower.len() + name.len()).saturating_sub(2 * kept),
    }
}

/// Whether two names in small letters have other numbers, or both name a side, and not the same.
fn is_of_another_part(known: &str, name: &str) -> bool {
    let sides = |name| words(name, char::is_alphabetic).filter(|word| SIDES.contains(word));
    let is_other = !sides(known).eq(sides(name));
    let have_some = sides(known).next().is_some() && sides(name).next().is_some();
    let digits = |name| words(name, |letter: char| letter.is_ascii_digit());
    is_other && have_some || !digits(known).eq(digits(name))
}

fn words(name: &str, is_of: fn(char) -> bool) -> impl Iterator<Item = &str> {
    name.split(move |letter: char| !is_of(letter)).filter(|word| !word.is_empty())
}
