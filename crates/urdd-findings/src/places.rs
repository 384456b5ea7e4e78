//! Leaves out some places of findings, parts a finding by its places, and bounds the memory of a run of many URDDs: places
//! beyond a limit are counted and dropped. The result depends on the URDDs alone, not on the order of their examination.

use super::check::{Check, Outcome};
use super::finding::{Finding, bytes};
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

/// Approximate memory limit for the places of a run, in bytes.
pub const KEPT_OF_RUN: usize = 256 << 20;
/// The least that each URDD may keep, in bytes.
pub const LEAST_OF_URDD: usize = 256 << 10;

/// Memory limit for the places of each URDD of a run, in bytes.
pub fn of_each(urdds: usize) -> usize {
    (KEPT_OF_RUN / urdds.max(1)).max(LEAST_OF_URDD)
}

/// Approximate memory of a finding without its texts, in bytes. A constant, so that a report is the same on every
/// machine.
const FINDING: usize = 256;

/// Drops places beyond `most` bytes. Keeps the worst places of each finding and at least one finding of each rule.
/// Counts include what is dropped.
pub fn trim(checks: &mut [Check], most: usize) {
    let mut left = most;
    for check in checks {
        let mut kept = 0;
        for finding in &mut check.findings {
            let first = finding.message.len() + FINDING;
            if left < first && kept > 0 {
                break;
            }
            kept += 1;
            left = left.saturating_sub(first);
            let fits = |other: &&Place| {
                let bytes = bytes(other);
                let fits = bytes <= left;
                left = left.saturating_sub(bytes);
                fits
            };
            let places = finding.more.iter().take_while(fits).count();
            finding.more.truncate(places);
            finding.more.shrink_to_fit();
        }
        let cut: usize = check.findings.drain(kept..).map(|f| f.count).sum();
        if let Some(last) = check.findings.last_mut() {
            last.count += cut;
        }
    }
}
