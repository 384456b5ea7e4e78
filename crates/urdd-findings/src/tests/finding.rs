//! Findings, and folding of similar ones.

use crate::finding::bytes;
use crate::finding::*;

#[test]
fn a_flood_is_folded_by_kind_of_place() {
    let mut findings = Findings::default();
    const MANY: usize = 2 * KEPT_PLACES;
    for i in 0..MANY {
        findings.report(Finding::at("a.json", format!("/m/{i}/0"), "wrong").actual(i));
        findings.report(Finding::at("b.json", format!("/m/{i}/0"), "wrong"));
    }
    findings.report(Finding::at("a.json", "/n/7", "wrong"));
    let findings = findings.take();
    assert_eq!(findings.iter().map(|f| f.count).collect::<Vec<_>>(), [MANY, MANY, 1]);
    assert_eq!(findings[0].more[1].actual.as_deref(), Some("2"));
}

#[test]
fn what_is_kept_is_bounded_and_all_is_counted() {
    let mut findings = Findings::default();
    for i in 0..2 * KEPT_FINDINGS {
        findings.report(Finding::at("a.json", format!("/k{i}"), "wrong"));
    }
    for _ in 0..5 {
        for k in 0..5 {
            for i in 0..KEPT_PLACES {
                findings.report(Finding::at("a.json", format!("/k{k}"), "wrong").actual(i));
            }
        }
    }
    let findings = findings.take();
    assert_eq!(findings.len(), KEPT_FINDINGS);
    let counts: usize = findings.iter().map(|finding| finding.count).sum();
    assert_eq!(counts, 2 * KEPT_FINDINGS + 25 * KEPT_PLACES);
    let more = findings.iter().flat_map(|finding| &finding.more);
    let bytes: usize = more.map(bytes).sum();
    assert!((KEPT_BYTES..KEPT_BYTES + 1000).contains(&bytes), "{bytes}");
}

#[test]
fn long_messages_are_counted_as_what_they_take() {
    let mut findings = Findings::default();
    let long = "x".repeat(100_000);
    for i in 0..1000 {
        findings.report(Finding::at("a.json", format!("/k{i}"), format!("{i}{long}")));
    }
    let findings = findings.take();
    let kept: usize = findings.iter().map(|finding| finding.message.len()).sum();
    assert!((10_000_000..20_000_000).contains(&kept), "{kept}");
    assert_eq!(findings.iter().map(|finding| finding.count).sum::<usize>(), 1000);
}

#[test]
fn spots_outlive_folding() {
    let mut all = Findings::remembering_spots();
    for i in 0..10 {
        all.report(Finding::at("a.json", format!("/m/{i}"), "wrong"));
    }
    let mut both = Findings::only_at(all.into_spots());
    for i in 8..20 {
        both.report(Finding::at("a.json", format!("/m/{i}"), "wrong").actual(i));
    }
    both.report(Finding::at("b.json", "/m/8", "wrong"));
    assert!(!both.is_empty());
    let both = both.take();
    assert_eq!(both.iter().map(|f| f.count).collect::<Vec<_>>(), [2]);
    assert_eq!(both[0].place.actual.as_deref(), Some("8"));
}

#[test]
fn keys_are_not_taken_for_indices() {
    assert_eq!(without_indices("/links/12/name"), "/links/*/name");
    assert_eq!(without_indices("/12a/0"), "/12a/*");
    assert_eq!(without_indices(""), "");
}
