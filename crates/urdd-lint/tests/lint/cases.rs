//! `tests/cases/CODE/invalid*.urdf` and `near_miss*.urdf`.

use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};

use urdd_findings::code::Code;
use urdd_format::report::{Cause, Verdict};
use urdd_lint::{LintRule, LintSettings, lint, rules};

fn folder_of(code: Code) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases")).join(code.as_str())
}

/// The URDFs of a rule whose names begin with `prefix`.
pub fn cases(code: Code, prefix: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder_of(code));
    let entries = entries.unwrap_or_else(|error| panic!("{code} has no cases: {error}"));
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut found: Vec<PathBuf> = paths
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with(prefix) && (name.ends_with(".urdf") || name.ends_with(".urdf.xacro"))
        })
        .collect();
    found.sort();
    assert!(!found.is_empty(), "{code} has no case {prefix}*.urdf");
    found
}

/// A copy of a case's folder, with all that the case names, and the case in it.
pub fn copied(case: &Path) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut left = vec![(case.parent().expect("a folder").to_owned(), folder.path().to_owned())];
    while let Some((from, to)) = left.pop() {
        fs::create_dir_all(&to).expect("a folder");
        for entry in fs::read_dir(&from).expect("read") {
            let entry = entry.expect("an entry");
            let (path, copy) = (entry.path(), to.join(entry.file_name()));
            match path.is_dir() {
                true => left.push((path, copy)),
                false => drop(fs::copy(&path, &copy).expect("copied")),
            }
        }
    }
    let file = folder.path().join(case.file_name().expect("a name"));
    (folder, file)
}

/// The codes and messages of what is found, with all rules that are on by default, and this one.
fn found(rule: &LintRule, file: &Path) -> Vec<(String, String)> {
    let description = &rule.description;
    let mut settings = LintSettings::default();
    settings.report.severities.insert(description.code, description.severity);
    let run = lint(&[file.to_owned()], &settings).expect("a report");
    let report = run.report.urdds.into_iter().next().expect("one file");
    // LNT065 says why there is no robot.
    let open = report.not_examined.as_ref().filter(|why| why.cause != Cause::Arguments);
    assert_eq!(open, None, "{}", file.display());
    assert_ne!(report.verdict, Verdict::Incomplete, "{}: a rule crashed", file.display());
    let findings = report.findings.into_iter();
    findings.map(|finding| (finding.code, finding.message)).collect()
}

/// Rules that need the program xacro: `tests/program/checked_in.rs` has one in its place.
const OF_XACRO: [Code; 1] = [Code::LNT067];

#[test]
fn a_rule_alone_finds_its_fault() {
    let is_plain = |rule: &&LintRule| !OF_XACRO.contains(&rule.description.code);
    for rule in rules::all().into_iter().filter(is_plain) {
        let code = rule.description.code;
        for file in cases(code, "invalid") {
            let found = found(rule, &file);
            let codes: BTreeSet<&str> = found.iter().map(|(code, _)| code.as_str()).collect();
            assert_eq!(
                codes,
                BTreeSet::from([code.as_str()]),
                "{}: {found:#?}\nLNT060 and LNT061 leave a fault to the rule that programs/faults.rs names; told.rs says which rule follows from which",
                file.display()
            );
        }
    }
}

#[test]
fn a_near_miss_has_no_finding() {
    for rule in rules::all() {
        for file in cases(rule.description.code, "near_miss") {
            assert_eq!(found(rule, &file), [], "{}", file.display());
        }
    }
}

/// Cases that are further than that from any invalid one, and why.
const FAR: [&str; 4] = [
    // Its joint slides, on the world.
    "LNT001/near_miss_slides.urdf",
    // All links are ten thousand times lighter.
    "LNT004/near_miss_massless.urdf",
    // Its base is the world.
    "LNT015/near_miss_world.urdf",
    // The invalid ones need xacro, and are short.
    "LNT065/near_miss.urdf",
];

/// The lines that one text has and the other has not, of both.
fn lines_apart(one: &str, other: &str) -> usize {
    let mut surplus: HashMap<&str, isize> = HashMap::new();
    one.lines().for_each(|line| *surplus.entry(line.trim()).or_default() += 1);
    other.lines().for_each(|line| *surplus.entry(line.trim()).or_default() -= 1);
    surplus.values().map(|many| many.unsigned_abs()).sum()
}

/// Where a few other lines make a fault of it, it is near. A robot that has nothing to do with the rule is no near miss.
#[test]
fn near_misses_are_near() {
    let read = |file: &PathBuf| fs::read_to_string(file).expect("a file");
    let mut far = Vec::new();
    for rule in rules::all() {
        let code = rule.description.code;
        let invalid: Vec<String> = cases(code, "invalid").iter().map(read).collect();
        for file in cases(code, "near_miss") {
            let text = read(&file);
            let least = invalid.iter().map(|invalid| lines_apart(invalid, &text)).min();
            if least > Some(8) {
                far.push(format!("{code}/{}", file.file_name().unwrap_or_default().display()));
            }
        }
    }
    assert_eq!(far, FAR, "write near misses from invalid cases, by as few lines as possible");
}

#[test]
fn every_code_of_the_family_is_a_rule_and_every_folder_a_code() {
    let declared: BTreeSet<Code> = rules::all().iter().map(|rule| rule.description.code).collect();
    let codes = Code::ALL.iter().filter(|code| code.family() == "LNT");
    assert_eq!(declared, codes.copied().collect());
    for entry in fs::read_dir(folder_of(Code::LNT001).parent().expect("a folder")).expect("read") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        assert!(name == "meshes" || Code::parse(&name).is_some(), "no rule has the cases {name}");
    }
}

/// At most 1 finding in 20 of a rule that is on by default is wrong, and the page has what was judged.
#[test]
fn a_rule_that_is_on_has_been_judged_on_real_robots() {
    let page = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../benches/evaluation/lint/evidence.md"
    ));
    let page = fs::read_to_string(page).expect("the page");
    for rule in rules::all().into_iter().filter(|rule| rule.on_by_default) {
        let (code, name) = (rule.description.code, rule.description.name);
        let judged = page.lines().any(|line| line == format!("## {code} {name}"));
        assert!(
            judged,
            "{code} is on by default, and no section `## {code} {name}` in benches/evaluation/lint/evidence.md says how often it is right"
        );
    }
}

/// What `cargo xtask new-rule` begins with.
#[test]
fn the_robot_of_the_scaffold_has_no_finding() {
    let scaffold = concat!(env!("CARGO_MANIFEST_DIR"), "/../../xtask/src/new_lint_rule.rs");
    let scaffold = fs::read_to_string(scaffold).expect("the scaffold");
    let robot = scaffold.split("const CASE: &str = r#\"").nth(1).expect("its robot");
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("arm.urdf");
    fs::write(&file, robot.split("\"#;").next().expect("its end")).expect("written");
    assert_eq!(found(rules::all()[0], &file), []);
}
