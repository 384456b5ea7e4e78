//! `URDD_CASE=SRC009 cargo test --test rules asked_for` judges these cases at once. The value is a code or a prefix of
//! one, or code, slash and name: `URDD_CASE=SRC009/nan`. `URDD_CASE=numbers` selects those that are made from the list of
//! numbers.
//!
//! `URDD_RULE=mute` runs them with a rule that finds nothing: every invalid case must fail. `URDD_RULE=alarm` runs them
//! with a rule that always finds something: every near miss must fail.

use std::collections::BTreeSet;
use std::fmt::Write;

use urdd_conformance::suite::{Case, CaseKind, Suite};
use urdd_findings::description::Description;
use urdd_findings::finding::Finding;
use urdd_format::report::Severity as Shown;
use urdd_validate::rule::{CheckOf, Rule};
use urdd_validate::rules;
use urdd_validate::settings::Settings;
use urdd_validate::validate_with;

use crate::judge;

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
        Stand::Mute => CheckOf::Robot(|_, _| Some(())),
        Stand::Alarm => CheckOf::Robot(|_, findings| {
            findings
                .report(Finding::in_directory("URDD_RULE=alarm: this rule always finds something"));
            Some(())
        }),
    };
    // A few, in a test.
    let description = Description { ..rule.description };
    Box::leak(Box::new(Rule { check, description, ..*rule }))
}

/// What is wrong with a case, or with its judgement; `None` if nothing is.
fn fault(suite: &Suite, case: &Case, stand: Stand) -> Option<String> {
    let rules: Vec<&'static Rule> = rules::all()
        .into_iter()
        .map(|rule| match rule.code.as_str() == case.code {
            true => stands_in(rule, stand),
            false => rule,
        })
        .collect();
    let folder = testkit::temporary::folder();
    let root = folder.path().join(case.urdd());
    let made = suite.tree(case).map_err(|error| error.to_string());
    let written = made.and_then(|urdd| case.write(&urdd, &root).map_err(|error| error.to_string()));
    if let Err(error) = written {
        return Some(format!("{}: cannot be made: {error}", case.id()));
    }
    let run = validate_with(&[&root], &Settings::default(), &rules).expect("something to examine");
    let report = run.report;
    let findings: Vec<_> = report
        .urdds
        .iter()
        .flat_map(|urdd| &urdd.findings)
        .filter(|finding| finding.severity != Shown::Info || finding.code == case.code)
        .collect();
    let own = findings.iter().any(|finding| finding.code == case.code);
    let others = findings.iter().any(|finding| finding.code != case.code);
    let caught = case.kind == CaseKind::Invalid;
    if own == caught && !others {
        // The right rule; the places count too.
        return match stand {
            Stand::Itself => judge::difference(case, &report),
            _ => None,
        };
    }
    let mut text = case.id();
    text += match (caught, own, others) {
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
    if let (false, Some(check)) = (own, checks.find(|check| check.code == case.code)) {
        let reason = check.reason.as_deref().unwrap_or_default();
        let _ = write!(text, "\n    {} itself: {} {reason}", case.code, check.status);
    }
    Some(text)
}

/// The substitute that `URDD_RULE` names.
fn stand() -> Stand {
    match std::env::var("URDD_RULE").as_deref() {
        Err(_) => Stand::Itself,
        Ok("mute") => Stand::Mute,
        Ok("alarm") => Stand::Alarm,
        Ok(other) => panic!("URDD_RULE={other}: write `mute` or `alarm`"),
    }
}

/// The prefix of the selected cases, by `URDD_CASE`. If set, tests of all other cases are skipped.
pub fn asked_for() -> Option<String> {
    std::env::var("URDD_CASE").ok()
}

/// Whether a case of this id is among those that begin so.
pub fn begins(start: &str) -> impl Fn(&str) -> bool {
    let numbers = (start == "numbers").then(crate::numbers::cases);
    let numbers: Option<BTreeSet<String>> =
        numbers.map(|cases| cases.iter().map(crate::Case::id).collect());
    move |id| match &numbers {
        Some(numbers) => numbers.contains(id),
        None => id.starts_with(start),
    }
}

/// The suite, with the cases that begin so alone.
fn beginning_with(start: &str) -> Suite {
    let mut suite = urdd::suite::carried().unwrap_or_else(|error| panic!("{error}"));
    let begins = begins(start);
    suite.cases.retain(|case| begins(&case.id()));
    suite
}

#[test]
fn a_case_that_is_asked_for_is_judged() {
    // Without a selection, a few: crates/urdd-conformance/tests checks the cases of all rules.
    let (start, stand) = match asked_for() {
        Some(start) => (start, stand()),
        None => ("DOF001".to_owned(), Stand::Itself),
    };
    let suite = beginning_with(&start);
    assert!(
        !suite.cases.is_empty(),
        "no case in conformance begins with {start:?}; write the code, or code/name"
    );
    let fault = |case| fault(&suite, case, stand);
    let faults: Vec<String> = suite.cases.iter().filter_map(fault).collect();
    assert!(
        faults.is_empty(),
        "{} of {} cases are judged wrong:\n\n{}\n",
        faults.len(),
        suite.cases.len(),
        faults.join("\n\n")
    );
    println!("{} cases are judged right", suite.cases.len());
}

/// Both failures are visible: that of the invalid case without the rule, and that of the near miss with a rule that
/// always finds something.
#[test]
fn cases_fail_with_another_rule() {
    let suite = beginning_with("DOF001");
    for case in &suite.cases {
        let fault = |stand| fault(&suite, case, stand);
        assert_eq!(fault(Stand::Itself), None);
        let (mute, alarm) = (fault(Stand::Mute), fault(Stand::Alarm));
        let wrong = if case.kind == CaseKind::Invalid { mute } else { alarm };
        let id = case.id();
        let wrong = wrong.unwrap_or_else(|| panic!("{id} passes with another rule"));
        assert!(wrong.starts_with(&id), "{wrong}");
    }
}
