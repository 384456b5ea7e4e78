//! Differences of the degrees of freedom: which there are, their indices, and bounds that do not follow from the joints.

use crate::dof_state::DofState;
use crate::fields::compare;
use crate::parts::{Matched, matched};
use crate::side::Side;
use urdd_format::diff_report::{DofDifference, Presence};
use urdd_format::index::Count;

/// The DOFs that differ.
pub(super) fn differences(before: &Side, after: &Side, tolerance: f64) -> Vec<DofDifference> {
    let names =
        |side: &Side| -> Vec<String> { side.dofs.iter().map(|dof| dof.name.clone()).collect() };
    let (a, b) = (names(before), names(after));
    let a: Vec<&str> = a.iter().map(String::as_str).collect();
    let b: Vec<&str> = b.iter().map(String::as_str).collect();
    let mut found = Vec::new();
    for part in matched(&a, &b) {
        let difference = match part {
            Matched::Removed(i) => difference(a[i], Presence::Removed, Some(i), None),
            Matched::Added(j) => difference(b[j], Presence::Added, None, Some(j)),
            Matched::Both(i, j) => {
                let (x, y) = (&before.dofs[i], &after.dofs[j]);
                let mut difference = difference(a[i], Presence::Changed, Some(i), Some(j));
                // What follows from the joint is said at the joint.
                let departs = |dof: &DofState| dof.stated.key() != dof.derived.key();
                if departs(x) || departs(y) {
                    difference.changes = compare("", &x.stated, &y.stated, tolerance);
                }
                if i == j && difference.changes.is_empty() {
                    continue;
                }
                difference
            }
        };
        found.push(difference);
    }
    found
}

fn difference(
    name: &str,
    presence: Presence,
    before: Option<usize>,
    after: Option<usize>,
) -> DofDifference {
    DofDifference {
        name: name.to_owned(),
        presence,
        index_before: before.map(Count::saturating),
        index_after: after.map(Count::saturating),
        changes: Vec::new(),
    }
}
