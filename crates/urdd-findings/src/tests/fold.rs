//! Reports many similar findings without building each of them.

use crate::finding::{Finding, Findings, Fold, KEPT_PLACES};

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
