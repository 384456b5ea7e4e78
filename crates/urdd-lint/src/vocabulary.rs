//! Names of URDF, and what is near to them.

pub use urdd_xml::vocabulary::{CLOSED, KNOWN, Known, of};

/// The name that another one is a misspelling of: the nearest, one edit away, or two where both have six letters, in any
/// case; or the only one that it is the beginning of.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    near(name, known).map(|(best, _)| best)
}

/// What a message says of the name that is meant, if any: nothing where numbers differ, as those of `arm_1` and `arm_2`.
pub fn hint(name: &str, known: &[&str]) -> String {
    let digits = |name: &str| name.replace(|letter: char| !letter.is_ascii_digit(), " ");
    let digits_of = |name| digits(name).split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    match nearest(name, known).filter(|near| digits_of(near) == digits_of(name)) {
        Some(near) => format!(", but there is `{near}`"),
        None => String::new(),
    }
}

/// Whether a value is one that an attribute of URDF can have: as many numbers as it needs, or a word.
pub fn fits(attribute: &str, value: &str) -> bool {
    let wanted = match attribute {
        "name" | "type" | "version" | "filename" | "link" | "joint" => return !value.is_empty(),
        "xyz" | "rpy" | "size" | "scale" => 3,
        "rgba" | "quat_xyzw" => 4,
        _ => 1,
    };
    let mut numbers = value.split_ascii_whitespace().map(str::parse);
    let is_finite = |number: Result<f64, _>| number.is_ok_and(f64::is_finite);
    numbers.clone().count() == wanted && numbers.all(is_finite)
}

/// As [`nearest`], and whether no other name is as near.
pub fn near<'a>(name: &str, known: &[&'a str]) -> Option<(&'a str, bool)> {
    const LONG: usize = 100;
    if name.len() > LONG {
        return None;
    }
    let lower = name.to_lowercase();
    let longer: Vec<_> = known.iter().filter(|known| known.starts_with(&lower)).collect();
    if let ([one], true) = (&longer[..], lower.chars().count() >= 5) {
        return Some((one, true));
    }
    let edits = |known: &str| strsim::osa_distance(&lower, known);
    let best = known.iter().min_by_key(|known| (edits(known), **known))?;
    let letters = lower.chars().count().min(best.chars().count());
    let allowed = match letters {
        0..3 => 0,
        3..6 => 1,
        _ => 2,
    };
    let least = edits(best);
    let is_only = known.iter().filter(|known| edits(known) == least).count() == 1;
    (least <= allowed).then_some((best, is_only))
}
