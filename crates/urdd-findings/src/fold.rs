//! Reports many similar findings without building each of them.

use super::finding::{Finding, Findings, KEPT_PLACES};

/// Reports findings at one kind of place: builds the first few and counts the rest. For tables in which every element
/// may be wrong. When dropped, it reports the count of those that were not built.
pub struct Fold<'a> {
    findings: &'a mut Findings,
    seen: usize,
    last: Option<Finding>,
}

impl<'a> Fold<'a> {
    /// Reports into `findings`.
    pub fn new(findings: &'a mut Findings) -> Self {
        Fold { findings, seen: 0, last: None }
    }

    /// Adds a finding.
    pub fn add(&mut self, make: impl FnOnce() -> Finding) {
        self.seen += 1;
        if self.seen <= KEPT_PLACES || self.findings.wants_each() {
            self.findings.report(make());
        } else if self.last.is_none() {
            self.last = Some(make());
        }
    }
}

impl Drop for Fold<'_> {
    fn drop(&mut self) {
        if let Some(last) = self.last.take() {
            self.findings.report(last.count(self.seen - KEPT_PLACES));
        }
    }
}
