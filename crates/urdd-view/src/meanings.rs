//! The explanations of the rules in a report, where the page's module does not have them.

use std::collections::BTreeSet;

use serde_json::{Value, json};

/// The explanations of the rules in a report.
pub fn meanings(report: &Value) -> Value {
    let findings = report["urdds"][0]["findings"].as_array();
    let codes: BTreeSet<&str> =
        findings.into_iter().flatten().filter_map(|finding| finding["code"].as_str()).collect();
    let of_urdds = urdd_validate::rules::all().into_iter();
    let of_urdfs = urdd_lint::rules::all().into_iter();
    let known =
        of_urdds.map(|rule| &rule.description).chain(of_urdfs.map(|rule| &rule.description));
    let told = known.filter(|rule| codes.contains(&*rule.code.to_string()));
    told.map(|rule| {
        json!({
            "code": rule.code.to_string(),
            "name": rule.name,
            "severity": rule.severity.as_str(),
            "clause": rule.clause,
            "explanation": rule.explanation(),
        })
    })
    .collect()
}
