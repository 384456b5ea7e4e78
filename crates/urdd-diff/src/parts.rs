//! Matches the parts of two robots by name.

use std::collections::{HashMap, VecDeque};

use crate::fields::{Fields, compare};
use urdd_format::diff_report::{PartDifference, Presence};

/// A part in one robot or both: its index in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Matched {
    /// Only the first robot has it.
    Removed(usize),
    /// Only the second robot has it.
    Added(usize),
    /// Both have it.
    Both(usize, usize),
}

/// Matches parts by name: those of the first robot in order, then what only the second has. The first part with a name
/// matches the first one, the second the second, and so on: a URDD may have several.
pub(super) fn matched(before: &[&str], after: &[&str]) -> Vec<Matched> {
    let mut places: HashMap<&str, VecDeque<usize>> = HashMap::new();
    for (index, name) in after.iter().enumerate() {
        places.entry(name).or_default().push_back(index);
    }
    let mut taken = vec![false; after.len()];
    let mut found = Vec::with_capacity(before.len());
    for (index, name) in before.iter().enumerate() {
        match places.get_mut(name).and_then(|places| places.pop_front()) {
            Some(other) => {
                taken[other] = true;
                found.push(Matched::Both(index, other));
            }
            None => found.push(Matched::Removed(index)),
        }
    }
    let new = taken.iter().enumerate().filter(|(_, taken)| !**taken);
    found.extend(new.map(|(index, _)| Matched::Added(index)));
    found
}

/// The parts that differ.
pub(super) fn differences(
    before: &[(String, Fields)],
    after: &[(String, Fields)],
    tolerance: f64,
) -> Vec<PartDifference> {
    let a: Vec<&str> = before.iter().map(|(name, _)| name.as_str()).collect();
    let b: Vec<&str> = after.iter().map(|(name, _)| name.as_str()).collect();
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let (name, presence, changes) = match part {
            Matched::Removed(i) => (a[i], Presence::Removed, Vec::new()),
            Matched::Added(j) => (b[j], Presence::Added, Vec::new()),
            Matched::Both(i, j) => {
                let changes = compare("", &before[i].1, &after[j].1, tolerance);
                if changes.is_empty() {
                    continue;
                }
                (a[i], Presence::Changed, changes)
            }
        };
        found.push(PartDifference { name: name.to_owned(), presence, changes });
    }
    found
}
