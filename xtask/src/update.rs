//! `cargo xtask update`: regenerates what is generated from the source, and lists the changed files.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::check::{cargo, python_types};
use crate::source::files;

/// The places of generated text.
const GENERATED: &[&str] = &[
    "README.md",
    "SPEC.md",
    "conformance",
    "crates/urdd-lint/src/in_programs.rs",
    "crates/urdd-validate/tests",
    "docs",
    "python/lib/urdd",
    "schema",
    "tests/program",
    "tests/rules/clauses",
    "wasm/npm",
    "cpp/include/urdd_types.hpp",
];

/// What is written by tests that otherwise compare with it: its name, the program of these tests, and the tests. The cases
/// first: their number appears on the pages.
const WRITERS: &[(&str, &str, &[&str])] = &[
    ("cases", "rules", &["computed::the_suite_has"]),
    ("clauses", "rules", &["clauses::"]),
    ("counts", "conformance", &["cases::the_pages_say"]),
    ("exports", "export", &["carried::the_page", "front_ends::"]),
    ("types", "format", &["typescript::", "cpp_types::"]),
    ("imports", "program", &["imports::the_page"]),
    ("snapshots", "program", &["snapshots::"]),
    ("fields", "program", &["spec_agrees::the_annexes"]),
    ("programs", "lint", &["in_programs::"]),
];

/// What is written first, by no test.
const SCHEMAS: &str = "schemas";
/// Types for Python, which a script writes, are `types` too.
const TYPES: &str = "types";

/// The names of what can be updated.
pub fn names() -> impl Iterator<Item = &'static str> {
    [SCHEMAS].into_iter().chain(WRITERS.iter().map(|(name, ..)| *name))
}

/// Regenerates what these names are of, or everything without any; returns whether that succeeded.
///
/// # Errors
/// If a name is of nothing, or cargo cannot be run.
pub fn run(root: &Path, asked: &[&str]) -> Result<bool, String> {
    if let Some(unknown) = asked.iter().find(|name| names().all(|one| one != **name)) {
        let all = names().collect::<Vec<_>>().join(", ");
        return Err(format!("there is nothing to update that is called {unknown}: {all}"));
    }
    let is_asked = |name: &str| asked.is_empty() || asked.contains(&name);
    let before = texts(root);
    let failed = |error| format!("cargo cannot be run: {error}");
    let mut right = true;
    if is_asked(SCHEMAS) {
        let words =
            ["run", "--quiet", "--locked", "--bin", "urdd", "--", "schema", "export", "schema"];
        let schemas = cargo(root).args(words).output().map_err(failed)?;
        if !schemas.status.success() {
            right = false;
            eprint!("{}", String::from_utf8_lossy(&schemas.stderr));
        }
    }
    match is_asked(TYPES).then(|| python_types(root, &[])) {
        Some(Some(written)) => right &= written,
        Some(None) => println!("left out: types for Python (python3 is not installed)"),
        None => {}
    }
    for (_, program, tests) in WRITERS.iter().filter(|(name, ..)| is_asked(name)) {
        let tests = cargo(root)
            .args(["test", "--quiet", "--locked", "--workspace", "--no-fail-fast"])
            .args(["--test", program, "--"])
            .args(*tests)
            .env("URDD_UPDATE", "1")
            .env("INSTA_UPDATE", "always")
            .env_remove("URDD_CASE")
            .output()
            .map_err(failed)?;
        if !tests.status.success() {
            right = false;
            eprint!("{}", String::from_utf8_lossy(&tests.stderr));
            print!("{}", String::from_utf8_lossy(&tests.stdout));
        }
    }
    let after = texts(root);
    let mut changed = 0;
    for path in before.keys().chain(after.keys().filter(|path| !before.contains_key(*path))) {
        let word = match (before.get(path), after.get(path)) {
            (before, after) if before == after => continue,
            (None, _) => "new",
            (_, None) => "removed",
            _ => "changed",
        };
        println!("{word:8} {path}");
        changed += 1;
    }
    if changed == 0 {
        println!("Nothing changed.");
    }
    Ok(right)
}

/// Every file of [`GENERATED`] with its bytes.
fn texts(root: &Path) -> BTreeMap<String, Vec<u8>> {
    let read = |path: PathBuf| {
        let bytes = fs::read(&path).ok()?;
        Some((path.strip_prefix(root).unwrap_or(&path).display().to_string(), bytes))
    };
    files(root, GENERATED).into_iter().filter_map(read).collect()
}
