//! Names of URDF, and what is near to them.

use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use strsim::osa_distance;

pub use urdd_xml::vocabulary::{CLOSED, KNOWN, Known, of};

/// The name that another one is a misspelling of: the nearest, one edit away, or two where both have six letters, in any
/// case; or the only one that it is the beginning of.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    near(name, known).map(|(best, _)| best)
}

/// The names that something may have.
pub struct Names<'a> {
    all: Vec<&'a str>,
    set: HashSet<&'a str>,
    left: AtomicUsize,
}

/// Maximum number of steps of comparisons with all names: beyond, names that are not there have no hint.
const MAX_STEPS: usize = 4_000_000;

impl<'a> Names<'a> {
    /// All of these, of which some may be the same.
    pub fn new(names: impl Iterator<Item = &'a str>) -> Self {
        let all: Vec<&str> = names.collect();
        Names { set: all.iter().copied().collect(), all, left: MAX_STEPS.into() }
    }

    /// Whether a name is one of them.
    pub fn has(&self, name: &str) -> bool {
        self.set.contains(name)
    }

    /// What a message says of the name that is meant, if any: nothing where numbers differ, as those of `arm_1` and `arm_2`.
    pub fn hint(&self, name: &str) -> String {
        let steps = self.all.len() * (1 + name.len().min(LONG).pow(2) / 8);
        let left = self.left.load(Ordering::Relaxed).checked_sub(steps);
        let Some(left) = left.filter(|_| name.len() <= LONG) else { return String::new() };
        self.left.store(left, Ordering::Relaxed);
        let digits = |name: &str| name.replace(|letter: char| !letter.is_ascii_digit(), " ");
        let digits_of =
            |name| digits(name).split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        match nearest(name, &self.all).filter(|near| digits_of(near) == digits_of(name)) {
            Some(near) => format!(", but there is `{near}`"),
            None => String::new(),
        }
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

/// Longer names are not compared, bytes.
const LONG: usize = 100;
/// Names that are two edits apart differ by fewer bytes.
const MOST_BYTES: usize = 9;

/// As [`nearest`], and whether no other name is as near.
pub fn near<'a>(name: &str, known: &[&'a str]) -> Option<(&'a str, bool)> {
    if name.len() > LONG {
        return None;
    }
    let lower = name.to_lowercase();
    let longer: Vec<_> = known.iter().filter(|known| known.starts_with(&lower)).collect();
    if let ([one], true) = (&longer[..], lower.chars().count() >= 5) {
        return Some((one, true));
    }
    let is_near = |known: &&&str| known.len().abs_diff(lower.len()) < MOST_BYTES;
    let edits = known.iter().filter(is_near).map(|known| (osa_distance(&lower, known), *known));
    let edits: Vec<(usize, &str)> = edits.collect();
    let &(least, best) = edits.iter().min()?;
    let letters = lower.chars().count().min(best.chars().count());
    let allowed = match letters {
        0..3 => 0,
        3..6 => 1,
        _ => 2,
    };
    let is_only = edits.iter().filter(|(edits, _)| *edits == least).count() == 1;
    (least <= allowed).then_some((best, is_only))
}
