//! Differences of the degrees of freedom: which there are, their indices, and bounds that do not follow from the joints.

use crate::dof_state::DofState;
use crate::fields::compare;
use crate::parts::matched;
use crate::side::Side;
use urdd_format::diff_report::DofDifference;
use urdd_format::index::Count;

/// The DOFs that differ.
pub(super) fn differences(before: &Side, after: &Side, tolerance: f64) -> Vec<DofDifference> {
    let mut found = Vec::new();
    for part in matched(&names(before), &names(after)) {
        let mut changes = Vec::new();
        if let Some((i, j)) = part.both() {
            let (x, y) = (&before.dofs[i], &after.dofs[j]);
            // What follows from the joint is said at the joint.
            let departs = |dof: &DofState| dof.stated.key() != dof.derived.key();
            if departs(x) || departs(y) {
                changes = compare("", &x.stated, &y.stated, tolerance);
            }
            if i == j && changes.is_empty() {
                continue;
            }
        }
        found.push(DofDifference {
            name: part.name.to_owned(),
            presence: part.presence(),
            index_before: part.before.map(Count::saturating),
            index_after: part.after.map(Count::saturating),
            changes,
        });
    }
    found
}

fn names(side: &Side) -> Vec<&str> {
    side.dofs.iter().map(|dof| dof.name.as_str()).collect()
}
