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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_counted_and_a_few_are_built() {
        let mut findings = Findings::default();
        let mut built = 0;
        let mut fold = Fold::new(&mut findings);
        for i in 0..2 * KEPT_PLACES {
            fold.add(|| {
                built += 1;
                Finding::at("a.json", format!("/m/{i}/0"), "wrong").actual(i)
            });
        }
        drop(fold);
        let findings = findings.take();
        assert_eq!(findings.len(), 1);
        assert_eq!(findings[0].count, 2 * KEPT_PLACES);
        assert_eq!(findings[0].more.len(), KEPT_PLACES - 1);
        assert_eq!(built, KEPT_PLACES + 1);
    }
}
