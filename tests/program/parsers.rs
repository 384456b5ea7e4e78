//! Each parser of somebody else's bytes has one door. The table "Parsers" of docs/security.md says which; here it is held
//! to the manifests, and to the sources where Cargo cannot say it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::PathBuf;

use testkit::repository;

const WHAT_TO_DO: &str = "ask the crate that has the limit to read it, or, if there is none yet, give the new one a limit, a \
                          hostile test, and a row in the table \"Parsers\" of docs/security.md";

/// Dependencies that parse nothing which a stranger writes, or pieces of a text that another parser has bounded.
const OTHERS: &[&str] = &[
    "arrayvec",
    "clap",
    "clap_complete",
    "crossbeam-channel",
    "ctor",
    "earcut",
    "fearless_simd",
    "getrandom",
    "indicatif",
    "itoa",
    "json-patch",
    "libm",
    "lsp-types",
    "memchr",
    "meshoptimizer-rs",
    "memory-stats",
    "nalgebra",
    "numpy",
    "open",
    "parking_lot",
    "percent-encoding",
    "process-wrap",
    "pyo3",
    "rayon",
    "robust",
    "rustix",
    "same-file",
    "schemars",
    "semver",
    "serde",
    "sha2",
    "signal-hook",
    "similar",
    "strsim",
    "terminal_size",
    "textwrap",
    "thiserror",
    "unicode-general-category",
    "zmij",
];

/// Files that read JSON by `serde_json`, and what bounds the text. All else is read by `urdd_directory::json`.
const JSON: &[(&str, &str)] = &[
    ("crates/urdd-conformance/src/data.rs", "the suite's own"),
    ("crates/urdd-conformance/src/export.rs", "the suite's own"),
    ("crates/urdd-conformance/src/looped.rs", "the suite's own"),
    ("crates/urdd-conformance/src/refused.rs", "MAX_DOCUMENT_BYTES"),
    ("crates/urdd-conformance/src/suite.rs", "the suite's own"),
    ("crates/urdd-directory/src/json.rs", "the door: MAX_DOCUMENT_BYTES and DEPTH_LIMIT"),
    ("crates/urdd-directory/src/json_scan.rs", "a key of a document"),
    ("crates/urdd-directory/src/yaml/mod.rs", "a document that was read"),
    ("crates/urdd-directory/src/yaml/places.rs", "a number of a document"),
    (
        "crates/urdd-export/src/spheres/import.rs",
        "the limit of a list of spheres, before it is read",
    ),
    ("crates/urdd-findings/src/baseline.rs", "MAX_BASELINE_BYTES"),
    ("crates/urdd-format/src/registry.rs", "a document within MAX_DOCUMENT_BYTES"),
    ("crates/urdd-format/src/schema.rs", "the program's own"),
    ("crates/urdd-generate/src/donor/mod.rs", "MAX_DOCUMENT_BYTES"),
    ("crates/urdd-geometry/src/read/gltf/mod.rs", "a mesh within MAX_DOCUMENT_BYTES"),
    ("crates/urdd-source/src/trail.rs", "what the module beside xacro notes; 64 MiB"),
    ("crates/urdd-view/src/collection.rs", "MAX_DROP"),
    ("crates/urdd-view/src/http.rs", "the limit of a request's body"),
    ("crates/urdd-view/src/one_file.rs", "MAX_DOCUMENT_BYTES, MAX_ROBOT_BYTES, the program's own"),
    ("crates/urdd-view/src/report.rs", "the program's own"),
    ("crates/urdd-view/src/route.rs", "the program's own"),
    ("crates/urdd-view/src/site.rs", "MAX_LIST_BYTES"),
    ("src/cli/configurations.rs", "a line of a file within MAX_BYTES"),
    ("src/cli/conformance/common.rs", "MAX_LOG_LINE"),
    ("wasm/src/export.rs", "the page's own"),
    ("wasm/src/lint.rs", "the page's own"),
    ("wasm/src/make.rs", "the page's own"),
    ("wasm/src/robot.rs", "the page's own"),
    ("wasm/src/spheres.rs", "the page's own"),
];

/// Files that read a whole file of any size and kind, and why they may. All else is read by `urdd_directory::regular`.
const WHOLE_FILES: &[(&str, &str)] = &[
    ("crates/urdd-conformance/src/tree.rs", "the suite's own"),
    ("crates/urdd-directory/src/schema_files.rs", "the schemas that urdd writes"),
    ("crates/urdd-generate/src/donor/mod.rs", "two files of one size in the output"),
    ("crates/urdd-robot/src/batch.rs", "of the system"),
    ("crates/urdd-source/src/process/linux.rs", "of the system"),
    ("crates/urdd-view/src/collection.rs", "what was just written"),
    ("src/cli/watch.rs", "of the system"),
    ("src/suite/archive.rs", "the suite's own"),
];

/// The manifests of what users get: packages and their texts.
fn manifests() -> BTreeMap<String, String> {
    let folders = fs::read_dir(repository().join("crates")).expect("the crates");
    let folders = folders.map(|entry| entry.expect("an entry").path());
    let others = ["", "python", "wasm"].map(|name| repository().join(name));
    let text = |folder: PathBuf| {
        let text = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        let name = text.lines().find_map(|line| line.strip_prefix("name = ")).expect("a name");
        (name.trim_matches('"').to_owned(), text)
    };
    folders.chain(others).map(text).collect()
}

/// What a package depends on, but for its tests.
fn dependencies(manifest: &str) -> BTreeSet<&str> {
    let mut is_wanted = false;
    let mut found = BTreeSet::new();
    for line in manifest.lines() {
        if let Some(section) = line.strip_prefix('[') {
            is_wanted = section.ends_with("dependencies]")
                && !section.contains("dev-dependencies")
                && !section.starts_with("workspace");
        } else if is_wanted && line.starts_with(|first: char| first.is_ascii_alphabetic()) {
            found.extend(line.split(['.', ' ', '=']).next());
        }
    }
    found
}

/// The crates that the table names, and those that may depend on them: a word in brackets and backquotes of the first
/// cell, and words in backquotes of the first sentence of the second.
fn doors() -> BTreeMap<String, BTreeSet<String>> {
    let page = fs::read_to_string(repository().join("docs/security.md")).expect("the page");
    let (_, table) = page.split_once("\n## Parsers\n").expect("the table");
    let rows = table.split("\n## ").next().expect("a table").lines().filter_map(|line| {
        let (input, holds) = line.strip_prefix("| ")?.split_once(" | ")?;
        Some((input, holds.split(". ").next()?))
    });
    let words = |text: &str| -> Vec<String> {
        text.split('`').skip(1).step_by(2).map(str::to_owned).collect()
    };
    let mut doors = BTreeMap::new();
    for (input, sentence) in rows {
        if let Some((_, parser)) = input.split_once("(`") {
            let only = sentence.starts_with("Only ").then(|| words(sentence));
            let parser = parser.trim_end_matches("`)").to_owned();
            doors.insert(parser, only.unwrap_or_default().into_iter().collect());
        }
    }
    doors
}

#[test]
fn each_parser_has_the_doors_that_the_page_names() {
    let manifests = manifests();
    let doors = doors();
    assert!(manifests.len() > 20 && doors.len() > 15, "{doors:#?}");
    let mut users: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (package, manifest) in &manifests {
        for dependency in dependencies(manifest) {
            users.entry(dependency).or_default().insert(package);
        }
    }
    users.retain(|name, _| !manifests.contains_key(*name));
    for (name, packages) in &users {
        let Some(door) = doors.get(*name) else {
            assert!(OTHERS.contains(name), "`{name}` is new: if it parses, {WHAT_TO_DO}");
            continue;
        };
        assert!(!OTHERS.contains(name), "{name}");
        // JSON is everywhere; the next test is about it.
        if *name != "serde_json" {
            let door: BTreeSet<&str> = door.iter().map(String::as_str).collect();
            assert_eq!(packages, &door, "`{name}` (left: as in Cargo.toml): {WHAT_TO_DO}");
        }
    }
    let known = doors.keys().map(String::as_str).chain(OTHERS.iter().copied());
    let unused: Vec<&str> = known.filter(|name| !users.contains_key(name)).collect();
    assert!(unused.is_empty(), "{unused:?} are no dependencies any more");
}

/// The parser of XML is not even a dependency of tests: they have what users have.
#[test]
fn only_urdd_xml_names_the_parser_of_xml() {
    let mut named = Vec::new();
    for folder in ["", "crates"] {
        for entry in fs::read_dir(repository().join(folder)).expect("folders") {
            let manifest = entry.expect("an entry").path().join("Cargo.toml");
            let text = fs::read_to_string(&manifest).unwrap_or_default();
            let uses = text.lines().any(|line| line.starts_with("roxmltree"));
            named.extend(uses.then_some(manifest));
        }
    }
    assert_eq!(named, [repository().join("crates/urdd-xml/Cargo.toml")], "{WHAT_TO_DO}");
    let root = fs::read_to_string(repository().join("Cargo.toml")).expect("a manifest");
    assert!(!root.contains("roxmltree.workspace"), "{WHAT_TO_DO}");
}

/// The page has one parser of its own, with a limit.
#[test]
fn the_page_parses_xml_in_one_place() {
    let mut waiting = vec![repository().join("page/src")];
    let (mut named, mut sources) = (Vec::new(), 0);
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            let entries = fs::read_dir(&path).expect("a folder");
            waiting.extend(entries.map(|entry| entry.expect("an entry").path()));
        } else if path.extension().is_some_and(|ending| ending == "ts") {
            sources += 1;
            let text = fs::read_to_string(&path).expect("a source");
            let parses = ["DOMParser", "innerHTML", "createContextualFragment"];
            named.extend(parses.iter().any(|word| text.contains(word)).then_some(path));
        }
    }
    assert!(sources > 50, "{sources}");
    assert_eq!(named, [repository().join("page/src/missing.ts")], "{WHAT_TO_DO}");
    let text = fs::read_to_string(&named[0]).expect("a source");
    assert!(text.contains("MAX_TEXT = 4e6;") && text.contains("MAX_NAMES = 1000;"));
    let page = fs::read_to_string(repository().join("docs/security.md")).expect("the page");
    let row =
        "DOMParser) | Only `page/src/missing.ts`. At most 4,000,000 characters and 1,000 names";
    assert!(page.contains(row), "{WHAT_TO_DO}");
}

/// Who reads files around descriptions, beside what they name.
const NAMED_FILES: &[(&str, &str)] = &[
    ("crates/urdd-diff/src/open.rs", "the files of a URDD, by its own paths"),
    ("crates/urdd-import/src/imported.rs", "the description itself; 64 MiB, a USD 512 MiB"),
    ("crates/urdd-lint/src/lib.rs", "the xacro file that a person names, to show it; 64 MiB"),
    ("crates/urdd-lint/src/srdf.rs", "SRDFs beside the URDF, which it does not name; 16 MiB"),
    (
        "crates/urdd-source/src/described.rs",
        "xacro files of a folder that a person names, and what the gate opens of those that they include; 64 MiB",
    ),
    (
        "crates/urdd-source/src/format.rs",
        "descriptions in a folder that a person names; 64 MiB, a USD 512 MiB",
    ),
    ("crates/urdd-source/src/gate.rs", "the gate"),
    ("crates/urdd-source/src/inspect.rs", "meshes and their side files, for the gate alone"),
    ("crates/urdd-source/src/installed.rs", "`CMakeLists.txt` and `setup.py`; 1 MiB"),
    ("crates/urdd-source/src/load.rs", "the description itself; 64 MiB"),
    (
        "crates/urdd-source/src/loops/mod.rs",
        "what says of loops, which a person names, or beside the URDF; 1 MiB",
    ),
    (
        "crates/urdd-source/src/folder_facts.rs",
        "`package.xml`, `CMakeLists.txt`, `setup.py`; 1 MiB",
    ),
    ("wasm/src/about.rs", "a mesh that was given to the page, for its picture"),
    ("wasm/src/around.rs", "descriptions that were dropped; 64 MiB"),
    ("wasm/src/files.rs", "what was given to the page, for the page"),
    ("wasm/src/robot.rs", "the files of a URDD that was given to the page"),
];

/// The files of the libraries and programs of which the code, tests apart, has one of these words.
fn files_with(words: &[&str]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for folder in ["crates", "src", "wasm/src", "python/src"] {
        for (path, bytes) in testkit::files::below(&repository().join(folder)) {
            let is_test = path.contains("/tests/")
                || path.contains("/benches/")
                || path.contains("/examples/")
                || path.ends_with("tests.rs");
            if is_test || !path.ends_with(".rs") {
                continue;
            }
            let text = String::from_utf8_lossy(&bytes).into_owned();
            let code = text.split("#[cfg(test)]").next().expect("a text");
            let mut lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            if lines.any(|line| words.iter().any(|word| line.contains(word))) {
                found.insert(format!("{folder}/{path}"));
            }
        }
    }
    found
}

/// Who stores files, or shows some of those of another. What reads URDDs and what reads descriptions ask these alone.
const SOURCES: &[(&str, &str)] = &[
    ("crates/urdd-directory/src/discover.rs", "the files of a URDD among others"),
    ("crates/urdd-directory/src/root.rs", "any of them"),
    ("crates/urdd-directory/src/source/archive.rs", "a zip archive"),
    ("crates/urdd-directory/src/source/disk.rs", "a folder on disk"),
    ("crates/urdd-directory/src/source/memory.rs", "memory, and what a browser gives"),
];

#[test]
fn files_are_stored_in_one_place() {
    assert_listed(
        &["Source for "],
        SOURCES,
        "use `Memory`, `Archive` or `Disk` of `urdd_directory`",
    );
    let set = ["MAX_SET_"];
    let users: Vec<String> = files_with(&set).into_iter().collect();
    assert_eq!(
        users,
        [LIMITS, "crates/urdd-source/src/files.rs"],
        "{set:?}: `Files::of` checks it"
    );
}

/// The limits of files.
const LIMITS: &str = "crates/urdd-directory/src/limits.rs";

#[test]
fn a_limit_of_files_has_one_name_and_one_place() {
    let limits = fs::read_to_string(repository().join(LIMITS)).expect("the limits");
    let names = limits.lines().filter_map(|line| line.strip_prefix("pub const ")?.split_once(':'));
    let names: Vec<String> = names.map(|(name, _)| format!("const {name}:")).collect();
    assert!(names.len() > 15, "{names:?}");
    for name in &names {
        let found: Vec<String> = files_with(&[name]).into_iter().collect();
        assert_eq!(found, [LIMITS], "`{name}`: use this one, or give another limit another name");
    }
}

fn assert_listed(words: &[&str], list: &[(&str, &str)], advice: &str) {
    let found = files_with(words);
    let listed: BTreeSet<String> = list.iter().map(|(file, _)| (*file).to_owned()).collect();
    assert_eq!(
        found, listed,
        "{words:?} (left: in the sources): {advice}, or say in this test what bounds it"
    );
    assert!(list.iter().all(|(_, why)| !why.is_empty()));
}

#[test]
fn whoever_reads_json_has_a_limit() {
    let words = [
        "serde_json::from_str",
        "serde_json::from_slice",
        "serde_json::from_reader",
        "serde_json::Deserializer",
    ];
    assert_listed(&words, JSON, "read it by `urdd_directory::json`");
}

#[test]
fn whoever_reads_a_whole_file_has_a_limit() {
    assert_listed(
        &["fs::read(", "fs::read_to_string("],
        WHOLE_FILES,
        "read it by `urdd_directory::regular`",
    );
}

#[test]
fn whoever_reads_a_file_that_a_description_names_asks_the_gate() {
    assert_listed(
        &["files.read(", "files().read("],
        NAMED_FILES,
        "find and read it by `urdd_source::gate::Gate`, which decides folder, kind and size",
    );
}
