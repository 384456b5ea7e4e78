//! Compares the findings of `urdd validate` with those that a case expects.

use urdd_conformance::suite::{Case, Expected, Verdict};
use urdd_format::report::{self, Finding, Report, Severity};

/// The findings that a case of the rule `code` lists: all except infos of other rules.
pub fn found(code: &str, report: &Report) -> Vec<Expected> {
    let findings = report.urdds.iter().flat_map(|urdd| &urdd.findings);
    let counts = |finding: &&Finding| finding.severity != Severity::Info || finding.code == code;
    let mut found: Vec<Expected> = findings
        .filter(counts)
        .map(|finding| Expected {
            code: finding.code.clone(),
            file: finding.file.clone(),
            pointer: finding.pointer.clone(),
        })
        .collect();
    found.sort();
    found
}

/// The verdict of a report on one URDD.
pub fn verdict(report: &Report) -> Verdict {
    let all_are = |verdict| report.count(verdict) == report.urdds.len();
    match (all_are(report::Verdict::Pass), all_are(report::Verdict::Unreadable)) {
        (true, _) => Verdict::Accept,
        (false, true) => Verdict::Unreadable,
        (false, false) => Verdict::Reject,
    }
}

/// Describes how a report differs from what the case expects, with places as files of cases have them; `None` if it
/// matches.
pub fn difference(case: &Case, report: &Report) -> Option<String> {
    let (found, verdict) = (found(&case.code, report), verdict(report));
    if found == case.expected && verdict == case.verdict {
        return None;
    }
    let list = |findings: &[Expected]| -> String {
        let line = |finding: &Expected| {
            let parts = [("file", &finding.file), ("pointer", &finding.pointer)].into_iter();
            let part = |(key, value): (_, &Option<String>)| {
                value.as_ref().map(|value| format!("\"{key}\": {value:?}"))
            };
            let place = parts.filter_map(part).collect::<Vec<_>>().join(", ");
            format!("\n    {} {{{place}}}", finding.code)
        };
        match findings.is_empty() {
            true => " nothing".to_owned(),
            false => findings.iter().map(line).collect(),
        }
    };
    Some(format!(
        "{}: expected {:?} with{}\n  found {verdict:?} with{}",
        case.id(),
        case.verdict,
        list(&case.expected),
        list(&found)
    ))
}
