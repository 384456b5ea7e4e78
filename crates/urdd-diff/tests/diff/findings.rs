//! Findings that are new or gone.

use testkit::fixture::Fixture;
use testkit::workshop::Workshop;
use urdd_diff::{Options, Side, compare};
use urdd_format::report::Severity;

#[test]
fn a_mass_that_is_removed_is_a_new_finding() {
    let shop = Workshop::new();
    let text = shop.text("welding_arm");
    let after = shop.write("after.urdf", &text.replace("<mass value=\"14\"/>", ""));
    let open = |path| Side::open(path, &Options::default()).unwrap();
    let (a, b) = (open(&shop.path("welding_arm.urdf")), open(&after));
    let codes = |a, b| -> Vec<String> {
        let report = compare(a, b, 0.0).unwrap();
        let findings = report.findings.unwrap().into_iter();
        let texts = findings
            .map(|it| format!("{} {} {}", it.presence, it.code, it.subject.unwrap_or_default()));
        texts.collect()
    };
    let new = codes(&a, &b);
    assert!(new.iter().any(|it| it.starts_with("added SRC003") && it.contains("base")), "{new:?}");
    let gone = codes(&b, &a);
    assert_eq!(gone, new.iter().map(|it| it.replace("added", "removed")).collect::<Vec<_>>());
    assert_eq!(codes(&a, &a), Vec::<String>::new());
    assert_eq!(codes(&b, &b), Vec::<String>::new());
}

#[test]
fn a_broken_module_is_a_new_finding_with_both_verdicts() {
    let folder = testkit::temporary::folder();
    let (a, b) = (folder.path().join("a/toy"), folder.path().join("b/toy"));
    let mut fixture = Fixture::toy();
    fixture.write_to(&a);
    fixture.set("bounds_module", "/bounds/0/1", serde_json::json!(0.123));
    fixture.seal();
    fixture.write_to(&b);
    let open = |path| Side::open(path, &Options::default()).unwrap();
    let report = compare(&open(&a), &open(&b), 0.0).unwrap();
    assert_eq!(report.before.verdict.unwrap().as_str(), "pass");
    assert_eq!(report.after.verdict.unwrap().as_str(), "fail");
    let findings = report.findings.unwrap();
    assert!(findings.iter().any(|it| it.code.starts_with("BND")), "{findings:?}");
    // Information that follows from the module is not there any more.
    let mut faults = findings.iter().filter(|it| it.severity != Severity::Info);
    assert!(faults.all(|it| it.presence.as_str() == "added"), "{findings:?}");
}
