//! `cargo xtask check`: common omissions after adding a rule, a module or a message, each with its remedy.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::source::files;
use crate::{new_lint_rule, new_rule};

/// The remedy where what a name of `update` is of is stale.
macro_rules! updates {
    ($name:literal) => {
        concat!("cargo xtask update ", $name, ", and read what it wrote")
    };
}

/// The tests to run, by prefix of their path, and what to do if one fails.
const TESTS: &[(&str, &str)] = &[
    ("spec_agrees::the_annexes", updates!("fields")),
    (
        "spec_agrees::the_table_of_modules",
        "list the module in the table of SPEC.md, clause 2.2.1, where the registry has it",
    ),
    (
        "spec_agrees::",
        "bring SPEC.md and the rule together: the rule's clause, its code in brackets after one sentence, MUST for errors, SHOULD for warnings",
    ),
    ("architecture::files_stay_small", "split the file by ideas"),
    (
        "architecture::every_rule_on_disk",
        "list the rule in `RULES` of its file, the file in crates/urdd-validate/src/rules/mod.rs, and its code in crates/urdd-findings/src/code.rs",
    ),
    ("architecture::", "see the message; CONTRIBUTING.md says how a rule is written"),
    ("snapshots::", updates!("snapshots")),
    ("cases::the_pages_say", updates!("counts")),
    (
        "cases::cases_are_judged",
        "look which is right, the case or the validator; `cargo xtask update cases` writes what the validator finds now",
    ),
    (
        "cases::every_rule_has",
        "write the case in conformance/cases: each rule has one that it catches, and one that comes near and passes",
    ),
    ("cases::", "see the message; conformance/README.md says what a case has"),
    (
        "computed::the_suite_has",
        "cargo xtask update cases, or URDD_UPDATE=1 URDD_CASE=CODE cargo test --test rules computed for one rule; read what it wrote",
    ),
    (
        "cases::a_rule_alone",
        "look which is right, the rule or crates/urdd-lint/tests/cases/CODE/invalid.urdf: its rule alone finds something there. If others rightly find the same fault, name the rule in programs/faults.rs (for LNT060 and LNT061) or in told.rs",
    ),
    ("cases::a_near_miss", "nothing is found in crates/urdd-lint/tests/cases/CODE/near_miss.urdf"),
    ("cases::near_misses_are_near", "change a few lines of invalid.urdf in near_miss.urdf"),
    (
        "cases::every_code_of_the_family",
        "see the message; list the rule in crates/urdd-lint/src/rules/mod.rs",
    ),
    (
        "clauses::since",
        "say in tests/rules/clauses/changes.txt what the sentence asks since 1.0.0; URDD_UPDATE=1 cargo test --test rules clauses adds the line",
    ),
    (
        "clauses::",
        "say in conformance/clauses which cases decide the statement, or why none can; URDD_UPDATE=1 cargo test --test rules clauses adds the line",
    ),
    ("a_case_that_is_asked_for", "see the message, and `urdd explain` of the rule"),
    ("published_schemas::the_committed_schemas", updates!("schemas")),
    (
        "published_schemas::",
        "see the message; a released schema never changes: make a new version of the module",
    ),
    (
        "annotations::every_field",
        "annotate the fields in crates/urdd-format/src: SPEC 11.3 and 11.4 have the words; what has none goes into a list in tests/program/annotations.rs, as a list with a length of its own",
    ),
    ("typescript::", updates!("types")),
    ("cpp_types::", updates!("types")),
    (
        "support_is_sound::toy_holds",
        "say in that test that the toy does not have the module, or make it in testkit/src/core_modules.rs",
    ),
    (
        "generate::core::what_is_asked_for",
        "see the message; crates/urdd-generate/src/stages.rs lists what `urdd generate` makes",
    ),
    ("links::", "mend the link: the file or heading that it names is not there"),
    ("security_doc::", "see the message"),
    ("parsers::", "see the message: docs/security.md has a row for each parser, and who calls it"),
    ("file_types::", "see the message: the page and editors know files by the program's endings"),
    ("carried::the_page", updates!("exports")),
    ("front_ends::users_are_told", "add a line to the first section of CHANGELOG.md"),
    ("front_ends::", updates!("exports")),
    ("in_programs::", updates!("programs")),
    ("imports::the_page", updates!("imports")),
    ("results::", "python3 benches/results.py: figures on the pages come from benches/results"),
];

/// The programs that have these tests.
const PROGRAMS: [&str; 6] = ["conformance", "export", "format", "lint", "program", "rules"];

/// Folders and files in which a scaffold leaves a TODO.
const SCAFFOLDED: &[&str] = &[
    "CHANGELOG.md",
    "SPEC.md",
    "crates/urdd-format/src",
    new_rule::RULES,
    new_rule::CASES,
    new_lint_rule::RULES,
    new_lint_rule::CASES,
];

/// Runs every check; returns whether all passed.
///
/// # Errors
/// If cargo cannot be run.
pub fn run(root: &Path) -> Result<bool, String> {
    let mut faults = 0;
    let mut fault = |what: &str, message: &str, remedy: &str| {
        faults += 1;
        println!("\nFAILED {what}\n{message}  -> {remedy}");
    };
    let left = left_to_write(root);
    if !left.is_empty() {
        let lines: String = left.iter().map(|place| format!("  {place}\n")).collect();
        fault("what a scaffold left to you", &lines, "write it");
    }
    let formatted = cargo(root).args(["fmt", "--check", "--quiet"]).output();
    if !formatted.is_ok_and(|output| output.status.success()) {
        fault("formatting", "", "cargo fmt");
    }
    match python_types(root, &["--check"]) {
        Some(false) => fault("types for Python", "", updates!("types")),
        Some(true) => {}
        None => println!("left out: types for Python (python3 is not installed)"),
    }
    let mut tests = vec!["test", "--locked", "--workspace", "--no-fail-fast"];
    tests.extend(PROGRAMS.iter().flat_map(|program| ["--test", program]));
    let failed = |error| format!("cargo cannot be run: {error}");
    // In view: it takes long. What cargo prints after tests that failed is left out.
    let built = cargo(root).args(&tests).arg("--no-run").status();
    if !built.map_err(failed)?.success() {
        fault("build", "", "see what cargo printed above");
    } else {
        let output = cargo(root)
            .args(&tests)
            .arg("--")
            .args(TESTS.iter().map(|(test, _)| test))
            // All cases of the suite, not a sample.
            .env("URDD_TRIALS", "4")
            .env("RUST_BACKTRACE", "0")
            .output()
            .map_err(failed)?;
        let text = String::from_utf8_lossy(&output.stdout);
        let failures = failures(&text);
        if failures.is_empty() && !output.status.success() {
            let message = String::from_utf8_lossy(&output.stderr);
            fault("tests", &message, "see the message");
        }
        for (test, message) in failures {
            let known = TESTS.iter().find(|(start, _)| test.starts_with(start));
            let remedy = known.map_or("see the message", |(_, remedy)| remedy);
            fault(test, &message, remedy);
        }
    }
    match faults {
        0 => println!("\nNothing is missing. Before you send: .ci/quick"),
        faults => println!("\n{faults} to mend"),
    }
    Ok(faults == 0)
}

/// Prints what decides the statements of SPEC.md; returns whether each has a line.
///
/// # Errors
/// If cargo cannot be run.
pub fn clauses(root: &Path) -> Result<bool, String> {
    let words = ["test", "--locked", "--quiet", "--workspace", "--test", "rules", "clauses::"];
    let status = cargo(root).args(words).args(["--", "--nocapture"]).status();
    status.map(|status| status.success()).map_err(|error| format!("cargo cannot be run: {error}"))
}

/// The cargo that started this program, in the repository.
pub fn cargo(root: &Path) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
    command.current_dir(root);
    command
}

/// Runs the script that writes the types for Python. `None` without python3.
pub fn python_types(root: &Path, arguments: &[&str]) -> Option<bool> {
    let script = Command::new("python3")
        .arg("python/scripts/make_types.py")
        .args(arguments)
        .current_dir(root)
        .output();
    script.ok().map(|output| output.status.success())
}

/// The TODOs that a scaffold left to the user: `SPEC.md:341`.
fn left_to_write(root: &Path) -> Vec<String> {
    let mut places = Vec::new();
    for path in files(root, SCAFFOLDED) {
        let text = fs::read_to_string(&path).unwrap_or_default();
        let shown = path.strip_prefix(root).unwrap_or(&path).display();
        for (number, line) in text.lines().enumerate() {
            if let Some(todo) = line.to_ascii_lowercase().find("todo") {
                let words: String = line[todo..].chars().take(80).collect();
                places.push(format!("{shown}:{}: {words}", number + 1));
            }
        }
    }
    places.sort();
    places
}

/// The tests that failed, each with what it printed.
fn failures(output: &str) -> Vec<(&str, String)> {
    let mut failures: Vec<(&str, String)> = Vec::new();
    let mut inside = false;
    for line in output.lines() {
        let title = line.strip_prefix("---- ");
        if let Some(test) = title.and_then(|title| title.strip_suffix(" stdout ----")) {
            failures.push((test, String::new()));
            inside = true;
        } else if line == "failures:" {
            inside = false;
        } else if let (true, Some((_, message))) = (inside, failures.last_mut()) {
            let of_rust = line.starts_with("thread '") || line.starts_with("note: run with");
            if !line.trim().is_empty() && !of_rust {
                *message += &format!("  {line}\n");
            }
        }
    }
    failures
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_are_read_from_what_cargo_prints() {
        let output = "test a::b ... FAILED\ntest a::c ... ok\n\nfailures:\n\n---- a::b stdout ----\n\n\
                      thread 'a::b' (7) panicked at x.rs:1:2:\nDOF003 is not in SPEC.md\n\
                      note: run with `RUST_BACKTRACE=1` environment variable to display a backtrace\n\n\nfailures:\n    a::b\n";
        let message = "  DOF003 is not in SPEC.md\n".to_owned();
        assert_eq!(failures(output), [("a::b", message)]);
    }

    #[test]
    fn what_is_to_be_updated_can_be() {
        let remedies = TESTS.iter().filter_map(|(_, remedy)| remedy.split("xtask update ").nth(1));
        for name in remedies.filter_map(|words| words.split([' ', ',', '`']).next()) {
            assert!(crate::update::names().any(|one| one == name), "{name}");
        }
        let all: Vec<&str> = crate::update::names().collect();
        assert!(crate::USAGE.contains(&format!("[{}]", all.join("|"))), "{all:?}");
    }

    #[test]
    fn what_is_left_to_write_is_found() {
        let folder = tempfile::tempdir().expect("a folder");
        let rules = folder.path().join("conformance/cases");
        fs::create_dir_all(&rules).expect("a folder");
        fs::write(rules.join("A.json"), "one\n  \"todo-x\"\n").expect("written");
        fs::write(folder.path().join("SPEC.md"), "TODO: say it\n").expect("written");
        let places = ["SPEC.md:1: TODO: say it", "conformance/cases/A.json:2: todo-x\""];
        assert_eq!(left_to_write(folder.path()), places);
    }
}
