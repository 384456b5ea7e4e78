//! What users see, as it was reviewed and approved: the list of rules, and the report on the examples, which
//! docs/validate.md shows too.

use urdd_validate::rules;

/// What docs/validate.md shows comes after this line.
const SHOWN: &str = "$ urdd validate examples/urdds\n";

fn urdd(arguments: &[&str]) -> String {
    let output = crate::program::output(arguments, testkit::repository());
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
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
                rule.clause.unwrap_or_default(),
                rule.name
            )
        })
        .collect();
    insta::assert_snapshot!("rules", lines);
}

/// A word that works goes on working (docs/promises.md).
#[test]
fn every_word_of_the_command_line() {
    let mut lines = Vec::new();
    words(&mut Vec::new(), &mut lines);
    insta::assert_snapshot!("command_line", lines.join("\n"));
}

/// The long options of a command, and then its subcommands.
fn words(command: &mut Vec<String>, lines: &mut Vec<String>) {
    let arguments: Vec<&str> = command.iter().map(String::as_str).chain(["--help"]).collect();
    let help = urdd(&arguments);
    let mut section = "";
    let (mut options, mut commands) = (Vec::<String>::new(), Vec::new());
    for line in help.lines() {
        if !line.is_empty() && !line.starts_with(' ') {
            section = line;
        }
        let words: Vec<&str> = line.split_whitespace().take(2).collect();
        if section == "Commands:" && line.starts_with("  ") && !line.starts_with("   ") {
            commands.push(words[0].to_owned());
        }
        let long = words.iter().find(|word| word.starts_with("--"));
        if let (Some(long), true) = (long, section == "Options:")
            && !options.iter().any(|known| known == long)
        {
            options.push((*long).to_owned());
        }
    }
    lines.push(format!("urdd {} {}", command.join(" "), options.join(" ")));
    for next in commands.into_iter().filter(|next| next != "help") {
        command.push(next);
        words(command, lines);
        command.pop();
    }
}

#[test]
fn the_report_on_the_examples() {
    let report = urdd(&["validate", "examples/urdds"]);
    insta::assert_snapshot!("examples", report);
    let how = "cargo test --test program snapshots";
    testkit::page::assert_between("docs/validate.md", [SHOWN, "\n```"], report.trim_end(), how);
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
