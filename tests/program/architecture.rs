//! The house keeps its shape: which room may import which, how large a file may grow, and that every
//! rule on disk is registered.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use urdd_validate::code::Code;
use urdd_validate::rules;

/// The rooms that each room may import, besides itself.
const ROOMS: &[(&str, &[&str])] = &[
    ("cancellation", &[]),
    ("format", &[]),
    ("directory", &["cancellation", "format"]),
    ("document", &["format", "directory", "kinematics"]),
    ("process", &["cancellation"]),
    ("xml", &[]),
    ("geometry", &["xml"]),
    ("kinematics", &["format"]),
    ("skips", &["format"]),
    (
        "learn",
        &["cancellation", "format", "geometry", "kinematics"],
    ),
    (
        "generate",
        &[
            "cancellation",
            "format",
            "directory",
            "geometry",
            "kinematics",
            "learn",
            "process",
            "skips",
            "xml",
        ],
    ),
    (
        "combine",
        &[
            "cancellation",
            "format",
            "directory",
            "kinematics",
            "generate",
            "xml",
        ],
    ),
    (
        "validate",
        &[
            "cancellation",
            "format",
            "directory",
            "document",
            "geometry",
            "kinematics",
            "xml",
        ],
    ),
    (
        "robot",
        &[
            "cancellation",
            "format",
            "directory",
            "document",
            "geometry",
            "kinematics",
            "learn",
            "skips",
        ],
    ),
    (
        "export",
        &[
            "format",
            "document",
            "geometry",
            "kinematics",
            "robot",
            "xml",
        ],
    ),
    ("report", &["format", "directory", "document", "validate"]),
    (
        "conformance",
        &[
            "cancellation",
            "format",
            "directory",
            "document",
            "geometry",
            "kinematics",
            "skips",
            "generate",
            "process",
            "validate",
            "report",
        ],
    ),
    (
        "view",
        &[
            "cancellation",
            "format",
            "directory",
            "robot",
            "validate",
            "report",
        ],
    ),
    (
        "cli",
        &[
            "cancellation",
            "format",
            "directory",
            "document",
            "geometry",
            "kinematics",
            "learn",
            "skips",
            "generate",
            "combine",
            "validate",
            "report",
            "robot",
            "view",
            "export",
            "conformance",
            "process",
        ],
    ),
];

/// Files under about 400 lines, rules under about 200: what "about" lets pass.
const LONGEST_FILE: usize = 420;
const LONGEST_RULE: usize = 210;

fn source() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of the source") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The rooms that a text names after `crate::`.
fn imported(text: &str) -> BTreeSet<String> {
    // What a comment links to is no import.
    let code = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let text = &code.collect::<Vec<_>>().join("\n");
    let mut rooms = BTreeSet::new();
    for (place, _) in text.match_indices("crate::") {
        let rest = &text[place + "crate::".len()..];
        // `use crate::{a, b::c}` as well as `crate::a::b`.
        let (list, nested) = match rest.strip_prefix('{') {
            Some(list) => (list.split('}').next().unwrap_or_default(), true),
            None => (rest, false),
        };
        for item in list.split(',') {
            let word: String = item
                .trim()
                .chars()
                .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
                .collect();
            rooms.insert(word);
            if !nested {
                break;
            }
        }
    }
    rooms
}

#[test]
fn rooms_import_only_what_they_may() {
    let mut seen = 0;
    for (room, allowed) in ROOMS {
        let folder = source().join(room);
        if !folder.is_dir() {
            continue;
        }
        for file in rust_files(&folder) {
            let text = fs::read_to_string(&file).expect("a source file");
            for import in imported(&text) {
                let is_room = ROOMS.iter().any(|(name, _)| *name == import);
                seen += usize::from(is_room);
                assert!(
                    !is_room || import == *room || allowed.contains(&import.as_str()),
                    "{} imports `{import}`, which `{room}` may not (see the table in this test)",
                    file.display()
                );
            }
        }
    }
    assert!(
        seen > 50,
        "only {seen} imports between rooms were found: the test looks at nothing"
    );
}

#[test]
fn the_wall_between_generate_and_validate_stands() {
    for (room, other) in [("generate", "validate"), ("validate", "generate")] {
        let files = rust_files(&source().join(room));
        assert!(!files.is_empty(), "src/{room} is empty");
        for file in files {
            let text = fs::read_to_string(&file).expect("a source file");
            let named =
                text.contains(&format!("crate::{other}")) || imported(&text).contains(other);
            assert!(
                !named,
                "{} names `{other}`: each must be written from SPEC.md alone",
                file.display()
            );
        }
    }
}

#[test]
fn imports_are_found_in_every_form() {
    let text = "use crate::a::b; use crate::{c, d::e};\n x = crate::f::g();";
    let found: Vec<String> = imported(text).into_iter().collect();
    assert_eq!(found, ["a", "c", "d", "f"]);
}

#[test]
fn files_stay_small() {
    let rules = source().join("validate/rules");
    for file in rust_files(&source()) {
        let lines = fs::read_to_string(&file)
            .expect("a source file")
            .lines()
            .count();
        let limit = if file.starts_with(&rules) {
            LONGEST_RULE
        } else {
            LONGEST_FILE
        };
        assert!(
            lines <= limit,
            "{} has {lines} lines; split it (at most {limit})",
            file.display()
        );
    }
}

#[test]
fn every_rule_on_disk_is_registered() {
    let mut on_disk = BTreeSet::new();
    for file in rust_files(&source().join("validate/rules")) {
        let text = fs::read_to_string(&file).expect("a source file");
        let Some(place) = text.find("declare_rule! {") else {
            continue;
        };
        let code = text[place..]
            .lines()
            .map(str::trim)
            .find(|line| !line.starts_with("///") && !line.starts_with("declare_rule"))
            .and_then(|line| line.split_whitespace().next())
            .expect("a code after the documentation");
        assert!(on_disk.insert(code.to_owned()), "{code} is declared twice");
    }
    let mut registered: BTreeSet<String> = rules::all()
        .iter()
        .map(|rule| rule.code.to_string())
        .collect();
    registered.insert("TST001".to_owned());
    assert_eq!(on_disk, registered);
    let codes: BTreeSet<String> = Code::ALL.iter().map(|code| code.to_string()).collect();
    assert_eq!(
        codes, registered,
        "src/validate/code.rs and the rules differ"
    );
}

#[test]
fn every_rule_is_documented_for_a_stranger() {
    let mut names = BTreeSet::new();
    for rule in rules::all() {
        let code = rule.code;
        let paragraphs = rule.explanation().split("\n\n").count();
        assert!(
            paragraphs >= 2,
            "{code}: say what is wrong, why it matters, and what to do"
        );
        assert!(
            rule.summary().ends_with('.'),
            "{code}: the first paragraph is a sentence"
        );
        let kebab = rule
            .name
            .bytes()
            .all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
        assert!(kebab, "{code}: `{}` is not kebab-case", rule.name);
        assert!(
            names.insert(rule.name),
            "{code}: the name `{}` is taken",
            rule.name
        );
    }
}
