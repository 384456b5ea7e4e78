//! What people see, kept as it was read and approved: the list of rules, and the report on the
//! examples, which docs/validate.md shows too.

use std::fs;

use urdd_validate::rules;

fn urdd(arguments: &[&str]) -> String {
    let output = crate::program::output(arguments, testkit::repository());
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Codes are never used again, names and severities do not change by accident.
#[test]
fn the_list_of_rules() {
    let lines: String = rules::all()
        .iter()
        .map(|rule| {
            format!(
                "{} {:7} {:7} {}\n",
                rule.code,
                rule.severity.as_str(),
                rule.clause,
                rule.name
            )
        })
        .collect();
    insta::assert_snapshot!("rules", lines);
}

#[test]
fn the_report_on_the_examples() {
    let report = urdd(&["validate", "examples/urdds"]);
    insta::assert_snapshot!("examples", report);
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/validate.md"))
        .expect("docs/validate.md");
    assert!(
        page.contains(report.trim_end()),
        "docs/validate.md does not show what `urdd validate examples/urdds` prints"
    );
}

#[test]
fn the_report_on_the_examples_for_other_programs() {
    for format in ["sarif", "junit"] {
        let report = urdd(&["validate", "examples/urdds", "--format", format]);
        insta::assert_snapshot!(format!("examples_{format}"), report);
    }
}

#[test]
fn an_explanation() {
    insta::assert_snapshot!("explain_DOF003", urdd(&["explain", "DOF003"]));
}
