//! Matches the parts of two robots by name.

use std::collections::{HashMap, VecDeque};

use crate::fields::{Fields, compare};
use urdd_format::diff_report::{PartDifference, Presence};

/// A part in one robot or both, with its index in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Matched<'a> {
    pub name: &'a str,
    pub before: Option<usize>,
    pub after: Option<usize>,
}

impl Matched<'_> {
    /// What became of it, if it differs where both have it.
    pub fn presence(&self) -> Presence {
        match (self.before, self.after) {
            (_, None) => Presence::Removed,
            (None, _) => Presence::Added,
            _ => Presence::Changed,
        }
    }

    pub fn both(&self) -> Option<(usize, usize)> {
        self.before.zip(self.after)
    }
}

/// Matches parts by name: those of the first robot in order, then what only the second has. The first part with a name
/// matches the first one, the second the second, and so on: a URDD may have several.
pub(super) fn matched<'a>(before: &[&'a str], after: &[&'a str]) -> Vec<Matched<'a>> {
    let mut places: HashMap<&str, VecDeque<usize>> = HashMap::new();
    for (index, name) in after.iter().enumerate() {
        places.entry(name).or_default().push_back(index);
    }
    let mut taken = vec![false; after.len()];
    let mut found = Vec::with_capacity(before.len());
    for (index, name) in before.iter().enumerate() {
        let other = places.get_mut(name).and_then(|places| places.pop_front());
        if let Some(other) = other {
            taken[other] = true;
        }
        found.push(Matched { name, before: Some(index), after: other });
    }
    let new = after.iter().enumerate().filter(|(index, _)| !taken[*index]);
    found.extend(new.map(|(index, name)| Matched { name, before: None, after: Some(index) }));
    found
}

pub(super) fn differences(
    before: &[(String, Fields)],
    after: &[(String, Fields)],
    tolerance: f64,
) -> Vec<PartDifference> {
    let a: Vec<&str> = before.iter().map(|(name, _)| name.as_str()).collect();
    let b: Vec<&str> = after.iter().map(|(name, _)| name.as_str()).collect();
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let (name, presence) = (part.name.to_owned(), part.presence());
        let changes = part.both().map(|(i, j)| compare("", &before[i].1, &after[j].1, tolerance));
        if changes.as_ref().is_none_or(|changes| !changes.is_empty()) {
            found.push(PartDifference { name, presence, changes: changes.unwrap_or_default() });
        }
    }
    found
}
