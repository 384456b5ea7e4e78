//! Bounds the places kept from a run of many URDDs: places beyond the bound are only counted. What is kept depends on
//! the URDDs alone, not on the order in which they were examined.

use super::Examined;
use super::finding::Occurrence;

/// Approximate number of bytes of places kept of a run, and at least of each URDD.
const KEPT_OF_RUN: usize = 256 << 20;
const LEAST_OF_URDD: usize = 256 << 10;

/// Number of bytes of places kept of each URDD of a run.
pub(super) fn of_each(urdds: usize) -> usize {
    (KEPT_OF_RUN / urdds.max(1)).max(LEAST_OF_URDD)
}

/// Keeps at most this many bytes of places: the worst ones of each finding, and at least one finding of each rule. What
/// is removed remains in the counts.
pub(super) fn trim(examined: &mut Examined, bytes: usize) {
    let mut left = bytes;
    for check in &mut examined.checks {
        let mut kept = 0;
        for finding in &mut check.findings {
            let first = finding.message.len() + size_of_val(finding);
            if left < first && kept > 0 {
                break;
            }
            kept += 1;
            left = left.saturating_sub(first);
            let fits = |other: &&Occurrence| {
                let bytes = other.bytes();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Outcome;
    use crate::finding::Finding;
    use crate::{RobotSize, rules};

    #[test]
    fn what_is_cut_stays_in_the_counts() {
        let flood = |rule: &&'static crate::rule::Rule| {
            let finding = |k: usize| {
                let mut finding = Finding::at("a.json", format!("/{k}"), "wrong").count(1001);
                finding.more = vec![Occurrence::default(); 1000];
                finding
            };
            let findings = (0..100).map(finding).collect();
            crate::engine::Check::new(rule, Outcome::Failed, findings)
        };
        let mut examined = Examined {
            name: "a".to_owned(),
            crashed: None,
            robot_name: None,
            size: RobotSize::default(),
            modules: Vec::new(),
            checks: rules::all().iter().take(5).map(flood).collect(),
        };
        const BYTES: usize = 1 << 20;
        trim(&mut examined, BYTES);
        let all = || examined.checks.iter().flat_map(|check| &check.findings);
        assert_eq!(
            all().map(|finding| finding.count).sum::<usize>(),
            5 * 100 * 1001
        );
        let places = all().flat_map(|finding| &finding.more);
        let bytes: usize = places.map(Occurrence::bytes).sum();
        assert!((BYTES / 2..=BYTES).contains(&bytes), "{bytes}");
        assert!(
            examined
                .checks
                .iter()
                .all(|check| !check.findings.is_empty())
        );
        // However many URDDs there are, something of each is kept.
        assert_eq!(of_each(1), KEPT_OF_RUN);
        assert_eq!(of_each(1_000_000), LEAST_OF_URDD);
    }
}
