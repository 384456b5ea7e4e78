//! Each promise of docs/security.md and docs/promises.md has tests, and they exist. docs/promises.md names them itself;
//! for docs/security.md, `security_doc.txt` does.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The tests of docs/security.md: a heading of the page (`# `), and below it a line for each row of its table: the
/// beginning of the row, ` | `, and its tests, or why none is needed (`by construction: `).
const SECURITY: &str = include_str!("security_doc.txt");

/// A line of [`SECURITY`].
#[derive(Debug)]
struct Promise {
    heading: &'static str,
    beginning: &'static str,
    held_by: Vec<&'static str>,
}

fn promises_of_security() -> Vec<Promise> {
    let mut promises = Vec::new();
    let mut heading = "";
    for line in SECURITY.lines() {
        if let Some(words) = line.strip_prefix("# ") {
            heading = words;
        } else if let Some((beginning, tests)) = line.split_once(" | ") {
            let held_by = tests.split(", ").collect();
            promises.push(Promise { heading, beginning, held_by });
        } else {
            assert!(line.is_empty(), "security_doc.txt: neither a heading nor a row: {line}");
        }
    }
    promises
}

/// The name of a test of the page, as one in Rust would have it.
fn as_identifier(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("_").to_lowercase()
}

/// Names of all tests in a folder: functions under `#[test]`, including those in macros, those of pytest, and those that
/// have a page of the browser.
fn tests_below(folder: &Path, names: &mut BTreeSet<String>) {
    for (path, bytes) in testkit::files::below(folder) {
        let text = String::from_utf8_lossy(&bytes);
        if path.ends_with(".rs") {
            for after in text.split("#[test]").skip(1) {
                let name = after.split_once("fn ").map(|(_, rest)| rest);
                let name = name.and_then(|rest| rest.split(['(', '<']).next());
                names.extend(name.map(|name| name.trim().to_owned()));
            }
        } else if path.ends_with(".py") {
            let starts = text.lines().filter_map(|line| line.strip_prefix("def "));
            let functions = starts.filter_map(|rest| rest.split('(').next());
            names.extend(functions.map(ToOwned::to_owned));
        } else if path.ends_with(".test.mjs") {
            let named = text.split("inPage(").skip(1);
            let named = named.filter_map(|rest| rest.split('"').nth(1));
            names.extend(named.map(as_identifier));
        }
    }
}

fn all_tests() -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tests = BTreeSet::new();
    for folder in ["src", "crates", "tests", "python/tests", "page/test"] {
        tests_below(&root.join(folder), &mut tests);
    }
    tests
}

fn page(name: &str) -> String {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    fs::read_to_string(docs.join(name)).expect("a page")
}

/// The rows of a page's tables: the heading above, and the cells.
fn rows(page: &str) -> Vec<(String, Vec<&str>)> {
    let mut rows = Vec::new();
    let mut heading = String::new();
    for line in page.lines() {
        if line.starts_with('#') {
            heading = line.trim_start_matches('#').trim().replace('`', "");
        }
        let is_heading = line.starts_with("| input |") || line.starts_with("| what |");
        if line.starts_with('|') && !line.starts_with("|---") && !is_heading {
            let cells = line.trim_matches('|').split('|').map(str::trim).collect();
            rows.push((heading.clone(), cells));
        }
    }
    rows
}

/// Fails if no test holds a promise, or one that does not exist.
fn assert_held(promise: &str, held_by: &[&str], tests: &BTreeSet<String>) {
    assert!(!held_by.is_empty(), "no test holds this promise: {promise}");
    for test in held_by {
        let name = test.rsplit("::").next().expect("a name");
        let exists = test.starts_with("by construction: ") || tests.contains(name);
        assert!(exists, "there is no test `{test}`: {promise}");
    }
}

#[test]
fn every_row_of_the_page_on_security_has_tests_that_exist() {
    let tests = all_tests();
    let page = page("security.md");
    let rows = rows(&page);
    assert!(rows.len() > 100, "{} rows", rows.len());
    let promises = promises_of_security();
    let is_of = |promise: &Promise, heading: &str, input: &str| {
        promise.heading == heading && input.starts_with(promise.beginning)
    };
    for (heading, cells) in &rows {
        assert_eq!(cells.len(), 2, "{heading}: {cells:?}");
        let input = cells[0];
        let its: Vec<&Promise> =
            promises.iter().filter(|promise| is_of(promise, heading, input)).collect();
        assert_eq!(its.len(), 1, "{heading}: {input}: its lines in security_doc.txt: {its:#?}");
        assert_held(input, &its[0].held_by, &tests);
    }
    for promise in &promises {
        let its = rows.iter().filter(|(heading, cells)| is_of(promise, heading, cells[0]));
        assert_eq!(its.count(), 1, "rows of docs/security.md that begin like this: {promise:#?}");
    }
}

#[test]
fn every_promise_names_tests_that_exist() {
    let tests = all_tests();
    let page = page("promises.md");
    // What follows the table of promises names no tests.
    let (promises, _) = page.split_once("\n## ").expect("a second heading");
    let rows = rows(promises);
    assert!(rows.len() > 8, "{} rows", rows.len());
    for (_, cells) in &rows {
        assert_eq!(cells.len(), 4, "{cells:?}");
        let names: Vec<&str> = cells[3].split('`').skip(1).step_by(2).collect();
        assert_held(cells[0], &names, &tests);
    }
}
