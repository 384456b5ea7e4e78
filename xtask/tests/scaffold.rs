//! The scaffolds of a rule and of a module, on a copy of the source.

#![allow(clippy::disallowed_methods)]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use tempfile::TempDir;

fn copy(from: &Path, to: &Path) {
    if from.is_dir() {
        fs::create_dir_all(to).expect("a folder");
        for entry in fs::read_dir(from).expect("a folder") {
            let entry = entry.expect("an entry");
            copy(&entry.path(), &to.join(entry.file_name()));
        }
    } else {
        fs::create_dir_all(to.parent().expect("a folder")).expect("a folder");
        fs::copy(from, to).expect("a file");
    }
}

/// The files that the scaffolds read and write.
fn source() -> TempDir {
    let folder = TempDir::new().expect("a folder");
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for part in [
        "crates/urdd-format/src/lib.rs",
        "crates/urdd-format/src/registry.rs",
        "crates/urdd-generate/src/selection.rs",
        "crates/urdd-findings/src/code.rs",
        "crates/urdd-validate/src/rules",
        "SPEC.md",
        "CHANGELOG.md",
        "conformance/cases",
        "tests/rules/bases.rs",
        "crates/urdd-lint/src/rules",
        "benches/evaluation/lint/evidence.md",
    ] {
        copy(&repository.join(part), &folder.path().join(part));
    }
    folder
}

fn new_rule(root: &Path, arguments: &[&str]) -> Output {
    xtask(root, "new-rule", arguments)
}

fn xtask(root: &Path, command: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_xtask"))
        .arg(command)
        .args(arguments)
        .arg("--root")
        .arg(root)
        .output()
        .expect("xtask runs")
}

fn text(root: &Path, path: &str) -> String {
    fs::read_to_string(root.join(path)).expect(path)
}

/// The next free code of a family.
fn next(root: &Path, family: &str) -> String {
    let codes = text(root, "crates/urdd-findings/src/code.rs");
    let of_family = codes.split_whitespace().filter(|word| word.starts_with(family));
    let numbers = of_family.filter_map(|word| word.get(3..)?.parse::<u32>().ok());
    format!("{family}{:03}", numbers.max().expect("a code") + 1)
}

#[test]
fn a_rule_gets_all_of_its_files() {
    let folder = source();
    let root = folder.path();
    let code = next(root, "SRC");
    let output =
        new_rule(root, &[&code, "is-of-cheese", "--clause", "6.1.7", "--severity", "warning"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains(&format!("URDD_CASE={code}")), "{said}");

    // In one of the files of its family: at the end of its table, and its check at the end.
    let files = ["inertia", "limits"]
        .map(|file| format!("crates/urdd-validate/src/rules/source/{file}.rs"));
    let rule = files.iter().map(|file| text(root, file)).find(|text| text.contains(&code));
    let rule = rule.expect("the rule");
    let declared = format!("{code} \"is-of-cheese\", Warning, clause \"6.1.7\"");
    let (table, checks) = rule.split_once("\n}\n").expect("a table");
    assert!(table.contains(&declared) && table.ends_with("check is_of_cheese,"), "{table}");
    assert!(checks.contains("\n}\n\nfn is_of_cheese(context: &Context,"), "{checks}");
    assert!(text(root, "crates/urdd-findings/src/code.rs").contains(&format!(" {code}")));
    let spec = text(root, "SPEC.md");
    let clause = spec
        .split("\n\n")
        .find(|clause| clause.trim_start().starts_with("**6.1.7**"))
        .expect("the clause");
    assert!(clause.trim_end().ends_with(&format!("[{code}]")), "{clause}");
    let changes = text(root, "CHANGELOG.md");
    let next = changes.split("\n## ").nth(1).expect("the next version");
    let line = format!("### Added\n\n- TODO: what {code} finds, for users.\n");
    assert!(next.contains(&line), "{next}");
    let cases = text(root, &format!("conformance/cases/{code}.json"));
    for words in [
        "\"rule\": \"is-of-cheese\"",
        "\"verdict\": \"accept\"",
        "\"invalid\": [\n    {\n      \"name\": \"todo-name-the-fault\",\n      \"base\": \"toy_core\"",
        "\"near_misses\": [\n    {\n      \"name\": \"todo-name-what-comes-near\",\n      \"base\": \"toy_core\"",
    ] {
        assert!(cases.contains(words), "{words}: {cases}");
    }

    // The second time, it is taken.
    let again = new_rule(root, &[&code, "is-of-cheese"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&again.stderr).contains("next free code"));
}

#[test]
fn every_family_can_have_another_rule() {
    let codes =
        text(&Path::new(env!("CARGO_MANIFEST_DIR")).join(".."), "crates/urdd-findings/src/code.rs");
    let list = codes.split_once("\ncodes! {").expect("the list").1;
    let list = list.split_once("\n}").expect("its end").0;
    let mut families: Vec<&str> =
        list.split_whitespace().filter_map(|code| code.get(..3)).collect();
    families.dedup();
    let folder = source();
    let mut made = 0;
    for family in families.into_iter().filter(|family| !["TST", "LNT"].contains(family)) {
        let code = next(folder.path(), family);
        let output = new_rule(folder.path(), &[&code, &format!("odd-{}", family.to_lowercase())]);
        assert!(output.status.success(), "{code}: {}", String::from_utf8_lossy(&output.stderr));
        made += 1;
    }
    assert!(made > 10);
}

#[test]
fn a_module_and_a_family_of_rules_get_all_of_their_files() {
    let folder = source();
    let root = folder.path();
    let succeeds = |command: &str, arguments: &[&str]| {
        let output = xtask(root, command, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{arguments:?}: {said}");
    };
    // The core modules have the clauses 6.1, 6.2 and so on.
    let modules = text(root, "SPEC.md").matches("\n### 6.").count();
    let clause = format!("6.{}", modules + 1);
    let first = format!("{clause}.1");
    succeeds("new-module", &["battery_pack"]);
    succeeds("new-rule", &["BAT001", "no-values", "--family", "battery_pack", "--clause", &first]);
    let elsewhere = new_rule(root, &["BAT002", "odd-values", "--clause", "6.1.7"]);
    let said = String::from_utf8_lossy(&elsewhere.stderr).into_owned();
    assert!(said.contains("6.1.7 is not about battery_pack_module"), "{said}");
    succeeds("new-rule", &["BAT002", "odd-values", "--clause", &first]);

    for (path, words) in [
        ("crates/urdd-format/src/battery_pack.rs", "pub struct BatteryPackModule {"),
        ("crates/urdd-format/src/lib.rs", "pub mod battery_pack;\npub mod bounds;"),
        (
            "crates/urdd-format/src/registry.rs",
            "BatteryPack(battery_pack::BatteryPackModule): BatteryPack @ \"1.0.0\", V1;\n    OriginalMeshes(",
        ),
        ("crates/urdd-generate/src/selection.rs", "(ModuleKind::BatteryPack, "),
        ("SPEC.md", &format!("### {clause} `battery_pack_module`\n\n**{clause}.1** TODO")),
        ("SPEC.md", "[BAT001] TODO: say what MUST or SHOULD be. [BAT002]\n\n## 7 "),
        (
            "SPEC.md",
            "|\n| `battery_pack_module` | `battery_pack_module` | (optional) | `urdf_module` |\n| `original_meshes_module` |",
        ),
        ("crates/urdd-findings/src/code.rs", "    BAT001 BAT002\n    LEG001"),
        ("crates/urdd-validate/src/rules/mod.rs", "pub mod battery_pack;\npub mod bounds;"),
        ("crates/urdd-validate/src/rules/mod.rs", "\n        battery_pack,\n    };"),
        ("crates/urdd-validate/src/rules/battery_pack.rs", "declare_rule! {\n    /// TODO"),
        (
            "crates/urdd-validate/src/rules/battery_pack.rs",
            "needs [ModuleV1(Kind::BatteryPack)], check no_values,\n\n    /// TODO",
        ),
        ("crates/urdd-validate/src/rules/battery_pack.rs", "check odd_values,\n}\n"),
        ("tests/rules/bases.rs", "            \"battery_pack\",\n            base(|| {"),
        ("tests/rules/bases.rs", "ModuleKind::BatteryPack"),
        ("conformance/cases/BAT002.json", "\"base\": \"battery_pack\""),
        ("conformance/cases/BAT002.json", "\"file\": \"battery_pack_module/module.json\""),
    ] {
        let text = text(root, path);
        assert!(text.contains(words), "{path} has no {words:?}:\n{text}");
    }

    for (name, words) in [
        ("battery_pack", "is there already"),
        ("bounds_module", "is there already"),
        ("creator", "is there already"),
        ("Battery", "is not a name"),
        ("3d", "is not a name"),
    ] {
        let output = xtask(root, "new-module", &[name]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(said.contains(words), "{name}: {said}");
    }
}

#[test]
fn what_is_not_generated_is_not_updated() {
    let folder = source();
    let output = xtask(folder.path(), "update", &["snapshot"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("called snapshot: schemas, cases"), "{said}");
}

#[test]
fn what_does_not_fit_writes_nothing() {
    let folder = source();
    let root = folder.path();
    let before = text(root, "crates/urdd-findings/src/code.rs");
    let [next, of_lint] = ["SRC", "LNT"].map(|family| next(root, family));
    let free = format!("next free code of the family is {of_lint}");
    for (arguments, words) in [
        (&["SRC999", "a-name"][..], "next free code"),
        (&["ABC001", "a-name"], "no family ABC"),
        (&["LNT999", "a-name"], "next free code"),
        (&["LNT054", "a-name"], &free),
        (&[&of_lint, "a-name", "--clause", "6.1"], "not for rules of lint"),
        (&[&of_lint, "misspelt"], "is there already"),
        (&["ABC002", "a-name", "--family", "abc"], "is ABC001"),
        (&["ABC001", "a-name", "--family", "a b"], "is not a name"),
        (&["ABC001", "a-name", "--family", "source"], "is there already"),
        (&[&next, "a-name", "--family", "source"], "leave out --family"),
        (&["src009", "a-name"], "is not a code"),
        (&["SRC01é", "a-name"], "is not a code"),
        (&[&next, "A Name"], "is not a name"),
        (&[&next, "crossed-limits"], "is there already"),
        (&[&next, "a-name", "--clause", "99.9"], "no clause 99.9"),
        (&[&next, "a-name", "--severity", "grave"], "write error, warning or info"),
        (&[&next], "cargo xtask new-rule"),
    ] {
        let output = new_rule(root, arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
    assert_eq!(text(root, "crates/urdd-findings/src/code.rs"), before);
}

#[test]
fn a_rule_of_lint_has_its_files() {
    let folder = source();
    let root = folder.path();
    let code = next(root, "LNT");
    let output = new_rule(root, &[&code, "fault-of-links"]);
    assert!(output.status.success(), "{output:?}");
    let rule = text(root, "crates/urdd-lint/src/rules/fault_of_links.rs");
    let declared = format!("{code} \"fault-of-links\", Warning, WrongMotion");
    assert!(rule.contains(&declared), "{rule}");
    let list = text(root, "crates/urdd-lint/src/rules/mod.rs");
    assert!(list.contains("mod fault_of_links;\n") && list.contains(" fault_of_links,"), "{list}");
    assert!(text(root, "crates/urdd-findings/src/code.rs").contains(&format!(" {code}\n")));
    for case in ["invalid", "near_miss"] {
        let case = text(root, &format!("crates/urdd-lint/tests/cases/{code}/{case}.urdf"));
        assert!(case.starts_with("<robot name="));
    }
}
