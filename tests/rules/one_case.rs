//! `URDD_CASE=SRC009 cargo test --test rules asked_for` judges these cases at once, from the closures, before any of
//! them is data. The value is a code or a prefix of one, or code, slash and name: `URDD_CASE=SRC009/nan`.
//! `URDD_CASE=numbers` selects those that are made from the list of numbers.
//!
//! `URDD_RULE=mute` runs them with a rule that finds nothing: every invalid case must fail. `URDD_RULE=alarm` runs them
//! with a rule that always finds something: every near miss must fail.

use std::fmt::Write;
use std::path::Path;

use urdd_findings::description::Description;
use urdd_findings::finding::{Finding, Findings};
use urdd_format::report::Severity as Shown;
use urdd_validate::rule::Rule;
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::validate_with;

use crate::{Case, cases};

/// The substitute for the rule of a case.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stand {
    /// The rule itself.
    Itself,
    /// A rule that finds nothing.
    Mute,
    /// A rule that finds something wherever it looks.
    Alarm,
}

fn stands_in(rule: &'static Rule, stand: Stand) -> &'static Rule {
    let check = match stand {
        Stand::Itself => return rule,
        Stand::Mute => |_: &_, _: &mut Findings| Some(()),
        Stand::Alarm => |_: &_, findings: &mut Findings| {
            findings
                .report(Finding::in_directory("URDD_RULE=alarm: this rule always finds something"));
            Some(())
        },
    };
    // A few, in a test.
    let description = Description { ..rule.description };
    Box::leak(Box::new(Rule { check, description, ..*rule }))
}

/// What is wrong with the judgement of a case; `None` if nothing is.
fn fault(case: &Case, stand: Stand) -> Option<String> {
    let rules: Vec<&'static Rule> = rules::all()
        .into_iter()
        .map(|rule| match rule.code == case.code {
            true => stands_in(rule, stand),
            false => rule,
        })
        .collect();
    let folder = testkit::temporary::folder();
    judged(case, &case.write(folder.path()), &rules)
}

fn judged(case: &Case, root: &Path, rules: &[&'static Rule]) -> Option<String> {
    let code = case.code.as_str();
    let run = validate_with(&[root], &Settings::default(), rules).expect("something to examine");
    let report = run.report;
    let findings: Vec<_> = report
        .urdds
        .iter()
        .flat_map(|urdd| &urdd.findings)
        .filter(|finding| finding.severity != Shown::Info || finding.code == code)
        .collect();
    let own = findings.iter().any(|finding| finding.code == code);
    let others = findings.iter().any(|finding| finding.code != code);
    if own == case.caught && !others {
        return None;
    }
    let mut text = format!("{code}/{}", case.name);
    text += match (case.caught, own, others) {
        (true, true, _) => ", an invalid case: other rules find something too",
        (true, false, true) => {
            ", an invalid case: other rules find something, and this one does not"
        }
        (true, false, false) => ", an invalid case: nothing is found",
        (false, _, _) => ", a near miss: something is found",
    };
    for finding in findings {
        let file = finding.file.as_deref().unwrap_or("the directory");
        let pointer = finding.pointer.as_deref().unwrap_or_default();
        let _ =
            write!(text, "\n    {} {file} {pointer}\n        {}", finding.code, finding.message);
        let expected = finding.expected.iter().map(|text| ("expected", text));
        let actual = finding.actual.iter().map(|text| ("actual", text));
        for (what, words) in expected.chain(actual) {
            let _ = write!(text, "\n        {what}: {words}");
        }
    }
    // Why the rule found nothing: it may not have run.
    let mut checks = report.urdds.iter().flat_map(|urdd| &urdd.checks);
    if let (false, Some(check)) = (own, checks.find(|check| check.code == code)) {
        let reason = check.reason.as_deref().unwrap_or_default();
        let _ = write!(text, "\n    {code} itself: {} {reason}", check.status);
    }
    Some(text)
}

/// The cases that `URDD_CASE` selects, and the substitute for their rule.
fn asked() -> Option<(String, Stand)> {
    let start = std::env::var("URDD_CASE").ok()?;
    let stand = match std::env::var("URDD_RULE").as_deref() {
        Err(_) => Stand::Itself,
        Ok("mute") => Stand::Mute,
        Ok("alarm") => Stand::Alarm,
        Ok(other) => panic!("URDD_RULE={other}: write `mute` or `alarm`"),
    };
    Some((start, stand))
}

/// The prefix of the selected cases. If set, tests of all other cases are skipped.
pub fn asked_for() -> Option<String> {
    asked().map(|(start, _)| start)
}

/// The cases whose code/name has this prefix.
pub fn beginning_with(start: &str) -> Vec<Case> {
    if start == "numbers" {
        return crate::numbers::cases();
    }
    let mut cases = cases();
    cases.retain(|case| format!("{}/{}", case.code, case.name).starts_with(start));
    cases
}

#[test]
fn a_case_that_is_asked_for_is_judged() {
    // Without a selection, a few: tests/conformance checks the cases of all rules.
    let (start, stand) = asked().unwrap_or(("DOF001".to_owned(), Stand::Itself));
    let cases = beginning_with(&start);
    assert!(
        !cases.is_empty(),
        "no case in tests/rules begins with {start:?}; write the code, or code/name"
    );
    // A case that cannot be made is told beside the others.
    let judged = |case: &Case| {
        let fault = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| fault(case, stand)));
        fault.unwrap_or_else(|_| Some(format!("{}/{}: cannot be made", case.code, case.name)))
    };
    let faults: Vec<String> = cases.iter().filter_map(judged).collect();
    assert!(
        faults.is_empty(),
        "{} of {} cases are judged wrong:\n\n{}\n",
        faults.len(),
        cases.len(),
        faults.join("\n\n")
    );
    println!("{} cases are judged right", cases.len());
}

/// Both failures are visible: that of the invalid case without the rule, and that of the near miss with a rule that
/// always finds something.
#[test]
fn cases_fail_with_another_rule() {
    for case in beginning_with("DOF001") {
        let id = format!("DOF001/{}", case.name);
        assert_eq!(fault(&case, Stand::Itself), None);
        let (mute, alarm) = (fault(&case, Stand::Mute), fault(&case, Stand::Alarm));
        let wrong = if case.caught { mute } else { alarm };
        let wrong = wrong.unwrap_or_else(|| panic!("{id} passes with another rule"));
        assert!(wrong.starts_with(&id), "{wrong}");
    }
}
