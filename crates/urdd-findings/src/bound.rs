//! Bounds the memory of a run of many URDDs: places beyond a limit are counted and dropped. The result depends on the
//! URDDs alone, not on the order of their examination.

use super::check::Check;
use super::memory::bytes;
use urdd_format::report::Place;

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
