//! The memory of a run of many URDDs: what is cut is counted.

use super::DESCRIPTION;
use crate::check::{Check, Outcome};
use crate::finding::{Finding, bytes};
use crate::places::*;
use urdd_format::report::Place;

#[test]
fn what_is_cut_stays_in_the_counts() {
    let flood = || {
        let finding = |k: usize| {
            let mut finding = Finding::at("a.json", format!("/{k}"), "wrong").count(1001);
            finding.more = vec![Place::default(); 1000];
            finding
        };
        let findings = (0..100).map(finding).collect();
        Check::new(&DESCRIPTION, Outcome::Failed, findings)
    };
    let mut checks: Vec<Check> = std::iter::repeat_with(flood).take(5).collect();
    const BYTES: usize = 1 << 20;
    trim(&mut checks, BYTES);
    let all = || checks.iter().flat_map(|check| &check.findings);
    assert_eq!(all().map(|finding| finding.count).sum::<usize>(), 5 * 100 * 1001);
    let places = all().flat_map(|finding| &finding.more);
    let bytes: usize = places.map(bytes).sum();
    assert!((BYTES / 2..=BYTES).contains(&bytes), "{bytes}");
    assert!(checks.iter().all(|check| !check.findings.is_empty()));
    // However many URDDs there are, each keeps something.
    assert_eq!(of_each(1), KEPT_OF_RUN);
    assert_eq!(of_each(1_000_000), LEAST_OF_URDD);
}
