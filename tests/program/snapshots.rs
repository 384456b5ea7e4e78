//! What users see, as it was reviewed and approved: the list of rules, and the report on the examples, which
//! docs/validate.md shows too.

use std::fs;

use urdd_validate::rules;

/// What docs/validate.md shows comes after this line.
const SHOWN: &str = "$ urdd validate examples/urdds\n";

fn urdd(arguments: &[&str]) -> String {
    let output = crate::program::output(arguments, testkit::repository());
    assert!(
        output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Codes are never reused; names and severities do not change by accident.
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
    let path = testkit::repository().join("docs/validate.md");
    let page = fs::read_to_string(&path).expect("docs/validate.md");
    let (head, rest) = page.split_once(SHOWN).expect("the page shows the report");
    let (shown, tail) = rest.split_once("\n```").expect("the report ends");
    let report = report.trim_end();
    if std::env::var_os("URDD_UPDATE").is_some() {
        fs::write(&path, format!("{head}{SHOWN}{report}\n```{tail}")).expect("written");
        return;
    }
    assert!(
        shown == report,
        "docs/validate.md does not show what `urdd validate examples/urdds` prints; URDD_UPDATE=1 writes it"
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
