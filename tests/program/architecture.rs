//! Rules about the source that Cargo does not enforce: the wall between generator and validator, the size of files, and
//! the registration of every rule on disk.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use testkit::repository;
use urdd_format::registry;
use urdd_validate::code::Code;
use urdd_validate::rules;

/// Files have at most about 400 lines, rules about 200: the tolerance of "about". Rules of one subject may share a file.
const LONGEST_FILE: usize = 420;
const LONGEST_RULE: usize = 210;

/// The source folders of the program and of each crate.
fn sources() -> Vec<PathBuf> {
    let mut folders = vec![repository().join("src")];
    for entry in fs::read_dir(repository().join("crates")).expect("the crates") {
        folders.push(entry.expect("an entry").path().join("src"));
    }
    assert!(folders.len() > 10, "{folders:?}");
    folders
}

fn rules_folder() -> PathBuf {
    repository().join("crates/urdd-validate/src/rules")
}

/// The Rust files below a folder: their texts, by their paths.
fn rust_files(folder: &Path) -> BTreeMap<PathBuf, String> {
    let files = testkit::files::below(folder).into_iter();
    files
        .filter(|(path, _)| path.ends_with(".rs"))
        .map(|(path, bytes)| (folder.join(path), String::from_utf8(bytes).expect("UTF-8")))
        .collect()
}

/// The crates have a version of their own, so what they write names the program's by a constant.
#[test]
fn all_say_one_version_of_the_program() {
    assert_eq!(registry::PROGRAM_VERSION, env!("CARGO_PKG_VERSION"));
}

#[test]
fn the_wall_between_generate_and_validate_stands() {
    for (name, other) in [
        ("urdd-generate", "urdd-validate"),
        ("urdd-validate", "urdd-generate"),
        ("urdd-validate", "urdd-learned"),
    ] {
        let manifest = repository().join("crates").join(name).join("Cargo.toml");
        let text = fs::read_to_string(&manifest).expect("a manifest");
        assert!(text.contains("urdd-format"), "{}: another form", manifest.display());
        assert!(
            !text.contains(other),
            "{} names `{other}`: each must be written from SPEC.md alone",
            manifest.display()
        );
    }
}

/// The table of `CONTRIBUTING.md` is the only list of floors: it names each crate once, and a crate uses only those above it.
#[test]
fn the_table_of_crates_has_all_of_them_lowest_first() {
    let text = fs::read_to_string(repository().join("CONTRIBUTING.md")).expect("the page");
    let rows = text.lines().skip_while(|line| !line.starts_with("| in `crates/` |")).skip(2);
    let names = rows.take_while(|line| line.starts_with('|')).flat_map(|row| {
        let cell = row.split('|').nth(1).expect("a first cell");
        cell.split('`').filter(|name| name.starts_with("urdd-")).collect::<Vec<_>>()
    });
    let names: Vec<&str> = names.collect();
    let folders = fs::read_dir(repository().join("crates")).expect("the crates");
    let folders = folders.map(|entry| entry.expect("an entry").file_name());
    let on_disk: BTreeSet<_> = folders.map(|name| name.into_string().expect("UTF-8")).collect();
    assert_eq!(names.len(), on_disk.len(), "{names:?}");
    assert_eq!(names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>(), on_disk);
    for (floor, name) in names.iter().enumerate() {
        let manifest = repository().join("crates").join(name).join("Cargo.toml");
        let text = fs::read_to_string(&manifest).expect("a manifest");
        let of_all = text.split("[dependencies]").nth(1).expect("dependencies");
        let used = of_all.split("[dev-dependencies]").next().unwrap_or_default().lines();
        for used in used.filter_map(|line| line.split('.').next()) {
            let its = names.iter().position(|one| *one == used);
            assert!(its.is_none_or(|its| its < floor), "{name} uses {used}, a row below it");
        }
    }
}

/// What the validator computes by itself is in one room, and CONTRIBUTING.md says of each part what it is held by.
#[test]
fn each_part_that_is_computed_twice_is_in_the_table() {
    let text = fs::read_to_string(repository().join("CONTRIBUTING.md")).expect("the page");
    let table = text.split("## What is computed twice").nth(1).expect("the table");
    let room = repository().join("crates/urdd-validate/src/reference");
    let parts = fs::read_dir(&room).expect("the room").map(|entry| entry.expect("an entry").path());
    for part in parts {
        let name = part.file_name().and_then(|name| name.to_str()).expect("a name");
        let shown = if part.is_dir() { format!("{name}/") } else { name.to_owned() };
        assert!(table.contains(&format!("`reference/{shown}`")), "no row has {shown}");
    }
}

/// A format of imports has unit tests of its name, a driver that asks a program whose format it is, and fuzzing.
#[test]
fn each_format_of_imports_is_tested() {
    let room = repository().join("crates/urdd-import/src");
    let formats =
        fs::read_dir(&room).expect("the room").map(|entry| entry.expect("an entry").path());
    let formats: Vec<PathBuf> =
        formats.filter(|path| path.is_dir() && !path.ends_with("tests")).collect();
    assert!(formats.len() >= 3, "{formats:?}");
    for format in formats {
        let name = format.file_name().and_then(|name| name.to_str()).expect("a name");
        let tests = [format!("{name}.rs"), format!("{name}/mod.rs")]
            .map(|file| room.join("tests").join(file));
        assert!(tests.iter().any(|file| file.exists()), "no unit tests of {name}");
        for file in
            [format!("tests/figures/imports/{name}.py"), format!("fuzz/fuzz_targets/{name}.rs")]
        {
            assert!(repository().join(&file).exists(), "no {file}");
        }
    }
}

/// Clippy refuses what writes files (`clippy.toml`). Only these files say that they may, and no library makes temporary
/// files in another way.
#[test]
fn files_are_written_by_one_way() {
    let rooms = [
        "urdd-directory/src/outputs.rs",
        "urdd-directory/src/regular.rs",
        "urdd-directory/src/staging.rs",
        "urdd-directory/src/take.rs",
        "urdd-directory/src/target_lock.rs",
        "urdd-directory/src/writer.rs",
        "urdd-lint/src/fix.rs",
        "urdd-view/src/site.rs",
    ];
    let mut found = BTreeSet::new();
    for folder in sources().into_iter().chain([repository().join("python/src")]) {
        for (file, source) in rust_files(&folder) {
            let own = source.split("#[cfg(test)]").next().unwrap_or_default();
            let is_test = file.components().any(|part| part.as_os_str() == "tests");
            if own.contains("disallowed_methods") && !is_test {
                found.insert(file);
            }
        }
        let manifest = folder.with_file_name("Cargo.toml");
        let text = fs::read_to_string(&manifest).expect("a manifest");
        let (before, _) = text.split_once("[dev-dependencies]").unwrap_or((&text, ""));
        assert!(!before.contains("tempfile"), "{}: use `temporary`", manifest.display());
    }
    let rooms = rooms.map(|file| repository().join("crates").join(file));
    assert_eq!(found, BTreeSet::from(rooms));
    let text = fs::read_to_string(repository().join("clippy.toml")).expect("settings");
    for method in ["fs::write", "fs::rename", "fs::copy", "File::create", "OpenOptions::new"] {
        assert!(
            text.contains(&format!("path = \"std::fs::{}\"", method.trim_start_matches("fs::"))),
            "{method}"
        );
    }
}

/// Where a library has no unit tests, or no examples, its manifest may say so, and Cargo builds nothing for them.
#[test]
fn no_test_and_no_example_is_left_out() {
    let has_test = |source: &str| source.contains("#[cfg(test)]");
    let mut without = 0;
    for folder in sources() {
        let manifest = folder.with_file_name("Cargo.toml");
        let text = fs::read_to_string(&manifest).expect("a manifest");
        let files = rust_files(&folder);
        let mut check = |line: &str, holds: &dyn Fn(&str) -> bool| {
            if !text.lines().any(|of| of == line) {
                return;
            }
            without += 1;
            for (file, source) in &files {
                assert!(
                    !holds(source),
                    "{} would not run: delete `{line}` from {}",
                    file.display(),
                    manifest.display()
                );
            }
        };
        check("test = false", &has_test);
        check("doctest = false", &has_example);
    }
    assert!(without > 10, "{without}: another form");
}

/// Whether Rust's documentation in a source has an example that is compiled.
fn has_example(source: &str) -> bool {
    let documentation = source.lines().filter_map(|line| {
        let line = line.trim_start();
        line.strip_prefix("///").or_else(|| line.strip_prefix("//!"))
    });
    let fences = documentation.filter_map(|line| line.trim_start().strip_prefix("```"));
    // Every second one ends a block.
    fences.step_by(2).any(|words| {
        words.is_empty()
            || ["rust", "no_run", "should_panic", "compile_fail"]
                .iter()
                .any(|word| words.starts_with(word))
    })
}

/// The number of rules that a file declares.
fn declared(text: &str) -> usize {
    let is_code = |word: &str| word.len() == 6 && Code::parse(word).is_some();
    let firsts = text.lines().filter_map(|line| line.trim_start().split_once(" \""));
    firsts.filter(|(word, _)| is_code(word)).count()
}

#[test]
fn files_stay_small() {
    let rules = rules_folder();
    for (file, text) in sources().iter().flat_map(|folder| rust_files(folder)) {
        let lines = text.lines().count();
        let is_rule = file.starts_with(&rules) && declared(&text) < 2;
        let limit = if is_rule { LONGEST_RULE } else { LONGEST_FILE };
        assert!(lines <= limit, "{} has {lines} lines; split it (at most {limit})", file.display());
    }
}

#[test]
fn every_rule_on_disk_is_registered() {
    let mut on_disk = BTreeSet::new();
    for text in rust_files(&rules_folder()).into_values() {
        for declared in text.split("declare_rule! {").skip(1) {
            let lines = declared.lines().take_while(|line| *line != "}").map(str::trim);
            // A file may declare several: after the documentation of each is its code.
            let codes = lines.filter_map(|line| line.split_once(" \"")).map(|(code, _)| code);
            let codes = codes.filter(|code| Code::parse(code).is_some());
            let before = on_disk.len();
            for code in codes {
                assert!(on_disk.insert(code.to_owned()), "{code} is declared twice");
            }
            assert!(on_disk.len() > before, "no code after the documentation");
        }
    }
    let mut registered: BTreeSet<String> =
        rules::all().iter().map(|rule| rule.code.to_string()).collect();
    registered.extend(["TST001", "TST002"].map(str::to_owned));
    assert_eq!(on_disk, registered);
    // The crate's own tests hold these to its files.
    let of_urdfs = urdd_lint::rules::all().into_iter();
    registered.extend(of_urdfs.map(|rule| rule.description.code.to_string()));
    let codes: BTreeSet<String> = Code::ALL.iter().map(|code| code.to_string()).collect();
    assert_eq!(codes, registered, "crates/urdd-findings/src/code.rs and the rules differ");
}

#[test]
fn every_rule_is_documented_for_a_stranger() {
    let mut names = BTreeSet::new();
    let of_urdds = rules::all().into_iter().map(|rule| &rule.description);
    let of_urdfs = urdd_lint::rules::all().into_iter();
    for rule in of_urdds.chain(of_urdfs.map(|rule| &rule.description)) {
        let code = rule.code;
        let paragraphs = rule.explanation().split("\n\n").count();
        assert!(paragraphs >= 2, "{code}: say what is wrong, why it matters, and what to do");
        assert!(rule.summary().ends_with('.'), "{code}: the first paragraph is a sentence");
        let kebab =
            rule.name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
        assert!(kebab, "{code}: `{}` is not kebab-case", rule.name);
        assert!(names.insert(rule.name), "{code}: the name `{}` is taken", rule.name);
    }
}
