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

#[cfg(test)]
mod tests {
    use super::{closeness, nearest};

    #[test]
    fn of_names_as_near_the_one_that_keeps_the_telling_part_is_proposed() {
        for (name, names, expected) in [
            ("R_lnk2", ["L_link2", "R_link2"], "R_link2"),
            ("lnk2_R", ["link2_L", "link2_R"], "link2_R"),
            ("arm_link4", ["arm_link3", "arm_lin4"], "arm_lin4"),
            ("left_wrst", ["left_wist", "left_wrist"], "left_wrist"),
            ("Elbow", ["albow", "elbow"], "elbow"),
        ] {
            assert_eq!(nearest(names.into_iter(), name).as_deref(), Some(expected), "{name}");
        }
    }

    #[test]
    fn sides_and_numbers_tell_parts_apart() {
        for (known, name, is_other) in [
            ("R_link2", "r_link2", false),
            ("L_link2", "R_link2", true),
            ("link_1", "link_2", true),
            ("left_hand", "lef_hand", false),
            ("front_left_wheel", "front_right_wheel", true),
        ] {
            assert_eq!(closeness(known, name).is_of_another_part, is_other, "{known} {name}");
        }
    }
}
