//! Orders the places of a finding.

use crate::check::worst_first;
use crate::finding::{Finding, Findings};

#[test]
fn the_worst_place_comes_first() {
    let mut findings = Findings::default();
    for (i, off) in [(0, 0.2), (1, -0.7), (2, 0.1), (3, f64::NAN)] {
        let finding = Finding::at("a.json", format!("/m/{i}"), format!("{i} is wrong"));
        findings.report(finding.actual(i).off_by(off, "m"));
    }
    let mut findings = findings.take();
    findings.iter_mut().for_each(worst_first);
    let [found] = &findings[..] else { panic!("one finding") };
    assert_eq!(found.place.pointer.as_deref(), Some("/m/3"));
    assert_eq!(found.message, "3 is wrong");
    let others: Vec<_> = found.more.iter().map(|o| o.actual.as_deref()).collect();
    assert_eq!(others, [Some("1"), Some("0"), Some("2")]);
    let words: Vec<_> = found.more.iter().map(|o| o.message.as_deref()).collect();
    let expected = ["1 is wrong", "0 is wrong", "2 is wrong"].map(Some);
    assert_eq!(words, expected);
}
