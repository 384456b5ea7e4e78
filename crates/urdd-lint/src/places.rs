//! Leaves out some places of findings.

use urdd_format::report::Place;
use urdd_validate::engine::{Check, Outcome};
use urdd_validate::finding::Finding;
use urdd_validate::skip::SkipReason;

/// Keeps the places of a rule's findings that `keeps` says. `reason` says why the rest was left out.
pub fn retain(check: &mut Check, reason: &str, mut keeps: impl FnMut(&Place) -> bool) {
    let before = check.findings.len();
    let findings = std::mem::take(&mut check.findings);
    let kept = findings.into_iter();
    check.findings = kept
        .filter_map(|finding| kept_of(finding, &mut keeps))
        .collect();
    if before > 0 && check.findings.is_empty() {
        check.outcome = Outcome::Skipped(SkipReason::Ignored(reason.to_owned()));
    }
}

fn kept_of(mut finding: Finding, keeps: &mut impl FnMut(&Place) -> bool) -> Option<Finding> {
    let all = std::iter::once(std::mem::take(&mut finding.place))
        .chain(std::mem::take(&mut finding.more));
    let said = |mut place: Place| {
        // The first place says it for those that follow, and may go.
        place.message.get_or_insert_with(|| finding.message.clone());
        place
    };
    let all: Vec<Place> = all.map(said).collect();
    let listed = all.len();
    let mut kept = all.into_iter().filter(keeps);
    let mut first = kept.next()?;
    let message = first.message.take()?;
    finding.more = kept.collect();
    for place in &mut finding.more {
        place.message.take_if(|other| *other == message);
    }
    finding.count -= listed - 1 - finding.more.len();
    (finding.place, finding.message) = (first, message);
    Some(finding)
}
