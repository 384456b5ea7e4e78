//! Leaves out some places of findings, or parts a finding by its places.

use super::check::{Check, Outcome};
use super::finding::Finding;
use super::skip::SkipReason;
use urdd_format::report::{Place, Severity};

/// Keeps the places of a rule's findings that `keeps` says; it is given each place, with its message, and its severity.
/// `reason` says why the rest was left out.
pub fn retain(
    check: &mut Check,
    reason: SkipReason,
    mut keeps: impl FnMut(Severity, &Place) -> bool,
) {
    let before = check.findings.len();
    for finding in std::mem::take(&mut check.findings) {
        let severity = finding.severity.unwrap_or(check.severity);
        let (groups, cut) = parted(finding, |place| keeps(severity, place));
        let kept = groups.into_iter().find(|(keeps, _)| *keeps);
        check.findings.extend(kept.map(|(_, mut kept)| {
            kept.count += cut;
            kept
        }));
    }
    if before > 0 && check.findings.is_empty() {
        check.outcome = Outcome::Skipped(reason);
    }
}

/// A finding for each value that `key` has at its places, and the number of its places that are not listed.
pub fn parted<K: PartialEq>(
    mut finding: Finding,
    mut key: impl FnMut(&Place) -> K,
) -> (Vec<(K, Finding)>, usize) {
    let cut = finding.count.saturating_sub(1 + finding.more.len());
    let first = std::mem::take(&mut finding.place);
    let more = std::mem::take(&mut finding.more);
    let mut groups: Vec<(K, Finding)> = Vec::new();
    for mut place in std::iter::once(first).chain(more) {
        // The first place says it for those that follow, and may go.
        let message = place.message.get_or_insert_with(|| finding.message.clone()).clone();
        let key = key(&place);
        match groups.iter_mut().find(|(other, _)| *other == key) {
            Some((_, group)) => {
                place.message.take_if(|other| *other == group.message);
                group.more.push(place);
                group.count += 1;
            }
            None => {
                place.message = None;
                let group = Finding { place, message, count: 1, ..finding.clone() };
                groups.push((key, group));
            }
        }
    }
    (groups, cut)
}
