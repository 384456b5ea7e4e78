//! Comments that allow findings.

use super::{SLIDE, codes, linted, written};
use urdd_lint::LintSettings;
use urdd_lint::told::codes_of;

/// The codes found where `comment` replaces what is at `at`, and the codes that are allowed in vain.
fn found(at: &str, with: &str) -> (Vec<String>, Vec<(Option<String>, String)>) {
    assert_eq!(SLIDE.matches(at).count(), 1);
    let (_folder, file) = written(&SLIDE.replace(at, with));
    let run = linted(&file, &LintSettings::default());
    let stale = run.report.stale_ignores.iter();
    let stale = stale.map(|ignore| (ignore.code.clone(), ignore.path.clone()));
    (codes(&run), stale.collect())
}

#[test]
fn an_allowed_finding_is_left_out() {
    for (at, with) in [
        ("<axis", "<!-- urdd: allow LNT012 it is a gear --><axis"),
        ("<joint", "<!-- urdd: allow SRC, LNT --><joint"),
        ("<robot", "<!-- urdd: allow LNT012 --><robot"),
        ("1.01\"/>", "1.01\"/> <!-- urdd: allow LNT012 -->"),
        ("<parent", "<!-- a word --><parent"),
    ] {
        let (codes, stale) = found(at, with);
        let is_allowed = with.contains("urdd:");
        assert_eq!(codes.is_empty(), is_allowed, "{with}: {codes:?}");
        // What no rule of SRC found: allowed in vain.
        let in_vain = usize::from(with.contains("SRC"));
        assert_eq!(stale.len(), in_vain, "{with}: {stale:?}");
    }
}

#[test]
fn a_comment_elsewhere_allows_nothing_and_is_named() {
    let line = 1 + SLIDE[..SLIDE.find("<limit").expect("it")].matches('\n').count();
    for code in ["LNT012", "LNT999"] {
        let (codes, stale) = found("<limit", &format!("<!-- urdd: allow {code} --><limit"));
        assert_eq!(codes, ["LNT012"]);
        assert_eq!(stale, [(Some(code.to_owned()), format!("slide.urdf:{line}"))]);
    }
}

#[test]
fn comments_in_one_another_are_all_used() {
    let text = SLIDE.replace("<joint", "<!-- urdd: allow LNT012 --><!-- urdd: allow LNT --><joint");
    let text = text
        .replace("<axis", "<!-- urdd: allow LNT012 --><axis")
        .replace("<robot", "<!-- urdd: allow LNT -->\n<robot");
    let (_folder, file) = written(&text);
    let run = linted(&file, &LintSettings::default());
    assert_eq!(codes(&run), [""; 0]);
    assert_eq!(run.report.stale_ignores, []);
}

#[test]
fn codes_stand_before_the_reason() {
    assert_eq!(codes_of(" urdd: allow LNT001 SRC, really "), Some(vec!["LNT001"]));
    assert_eq!(codes_of("urdd:allow LNT001 , SRC: see #3, #4"), Some(vec!["LNT001", "SRC"]));
    assert_eq!(codes_of(" urdd: allow "), None);
    assert_eq!(codes_of(" urdd: allowance "), None);
    assert_eq!(codes_of(" a comment about urdd: allow LNT001 "), None);
}
