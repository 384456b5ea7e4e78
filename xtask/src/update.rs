//! `cargo xtask update`: regenerates everything that is generated from the source, and lists the changed files.

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
    "wasm/npm",
    "cpp/include/urdd_types.hpp",
];

/// The tests that write what they compare with, by program. The cases first: their number appears on the pages.
const WRITERS: &[(&str, &[&str])] = &[
    ("rules", &["computed::the_suite_has", "clauses::"]),
    ("conformance", &["cases::the_pages_say"]),
    ("export", &["carried::the_page", "front_ends::"]),
    ("format", &["typescript::", "cpp_types::"]),
    ("lint", &["in_programs::"]),
    ("program", &["imports::the_page", "snapshots::", "spec_agrees::the_tables_of_fields"]),
];

/// Regenerates everything; returns whether that succeeded.
///
/// # Errors
/// If cargo cannot be run.
pub fn run(root: &Path) -> Result<bool, String> {
    let before = texts(root);
    let failed = |error| format!("cargo cannot be run: {error}");
    let schemas = cargo(root)
        .args(["run", "--quiet", "--locked", "--bin", "urdd", "--", "schema", "export", "schema"])
        .output()
        .map_err(failed)?;
    let mut right = schemas.status.success();
    if !right {
        eprint!("{}", String::from_utf8_lossy(&schemas.stderr));
    }
    match python_types(root, &[]) {
        Some(written) => right &= written,
        None => println!("left out: types for Python (python3 is not installed)"),
    }
    for (program, tests) in WRITERS {
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
