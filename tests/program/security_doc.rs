//! The promises of docs/security.md and docs/promises.md: each names tests, and they exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Names of all tests in a folder: functions under `#[test]`, including those in macros, and those of pytest.
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
        }
    }
}

/// The cells of a table's row.
fn cells(line: &str) -> Vec<&str> {
    line.trim_matches('|').split('|').map(str::trim).collect()
}

#[test]
fn every_promise_names_tests_that_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut tests = BTreeSet::new();
    for folder in ["src", "crates", "tests", "python/tests"] {
        tests_below(&root.join(folder), &mut tests);
    }
    let page = |name: &str| fs::read_to_string(root.join("docs").join(name)).unwrap();
    let (security, promises) = (page("security.md"), page("promises.md"));
    // What follows the table of promises names no tests.
    let (promises, _) = promises.split_once("\n## ").unwrap();
    let is_row = |line: &&str| {
        let is_heading = line.starts_with("| input |") || line.starts_with("| what |");
        line.starts_with('|') && !line.starts_with("|---") && !is_heading
    };
    let rows = |page| str::lines(page).filter(is_row).map(cells);
    let (security, promises): (Vec<_>, Vec<_>) =
        (rows(&security).collect(), rows(promises).collect());
    assert!(security.len() > 40, "{} rows", security.len());
    assert!(promises.len() > 8, "{} rows", promises.len());
    for row in security.into_iter().chain(promises) {
        assert_eq!(row.len(), 4, "{row:?}");
        let held_by = row[3];
        if held_by == "the same" || held_by.starts_with("by construction: ") {
            continue;
        }
        let names: Vec<&str> = held_by.split('`').skip(1).step_by(2).collect();
        assert!(!names.is_empty(), "no test holds this promise: {row:?}");
        for name in names {
            let name = name.rsplit("::").next().unwrap();
            assert!(tests.contains(name), "there is no test `{name}`: {row:?}");
        }
    }
}
