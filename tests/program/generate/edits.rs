//! A user's edits of the skips: a new run keeps them, or stops.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use urdd_generate::{Selection, Settings, generate};

use crate::generate::{bytes_below, findings_of, read_json, urdd};

const ROBOT: &str = r#"<robot name="r">
  <link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="b"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 3"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"#;
const SKIPS: &str = "link_shapes_modules/link_shapes_skips_module";

fn settings() -> Settings {
    Settings { num_samples: 5, ..Settings::default() }
}

fn edit() -> Value {
    json!({"link_a": "a", "link_b": "b", "skip": true, "reason": "a cable"})
}

/// A URDD with an edit in its JSON and YAML, as a user would write it: not canonical.
fn edited() -> (tempfile::TempDir, PathBuf, PathBuf) {
    let folder = testkit::temporary::folder();
    let source = folder.path().join("r.urdf");
    fs::write(&source, ROBOT).unwrap();
    let target = folder.path().join("out");
    generate(&source, &target, &settings(), &()).unwrap();
    write_edits(&target, &json!([edit()]));
    (folder, source, target)
}

fn write_edits(target: &Path, edits: &Value) {
    let file = target.join(SKIPS).join("module.json");
    let mut module = read_json(&file);
    module["edits"] = edits.clone();
    let text = serde_json::to_string_pretty(&module).unwrap();
    fs::write(&file, &text).unwrap();
    // JSON is YAML.
    fs::write(target.join(SKIPS).join("module.yaml"), text).unwrap();
}

#[test]
fn edits_are_kept() {
    let (_folder, source, target) = edited();
    generate(&source, &target, &settings(), &()).unwrap();
    let module = read_json(&target.join(SKIPS).join("module.json"));
    assert_eq!(module["edits"], json!([edit()]));
    assert_eq!(findings_of(&target), []);
    // Also if the rest of the URDD is missing or broken.
    for text in [None, Some("{"), Some("{}")] {
        let metadata = target.join("urdd.json");
        match text {
            None => fs::remove_file(&metadata).unwrap(),
            Some(text) => fs::write(&metadata, text).unwrap(),
        }
        let forced = Settings { force: true, ..settings() };
        generate(&source, &target, &forced, &()).unwrap();
        let module = read_json(&target.join(SKIPS).join("module.json"));
        assert_eq!(module["edits"], json!([edit()]), "{text:?}");
        assert_eq!(findings_of(&target), []);
    }
    // And if the module has the keys of an earlier draft.
    let file = target.join(SKIPS).join("module.json");
    fs::write(&file, json!({"edits": [edit()], "of_another_draft": 1}).to_string()).unwrap();
    fs::remove_file(target.join(SKIPS).join("module.yaml")).unwrap();
    generate(&source, &target, &settings(), &()).unwrap();
    assert_eq!(read_json(&file)["edits"], json!([edit()]));
}

#[test]
fn edits_that_cannot_be_read_stop_the_run() {
    let without = |key: &str| {
        let mut edit = edit();
        edit.as_object_mut().unwrap().remove(key);
        edit
    };
    let with = |key: &str, value: Value| {
        let mut edit = edit();
        edit[key] = value;
        edit
    };
    // The fault, the text, and the message with its location.
    let whole = |edits: Value| json!({"edits": edits}).to_string();
    let cases: Vec<(&str, String, &str)> = vec![
        (
            "a trailing comma",
            "{\"edits\": [\n  {\"link_a\": \"a\"},\n]}".to_owned(),
            "module.json:3:1: ",
        ),
        ("cut off", "{\"edits\": [".to_owned(), "module.json:1:"),
        ("empty", String::new(), "module.json:1:"),
        ("not UTF-8", "\u{0}".to_owned(), "module.json"),
        (
            "no reason",
            whole(json!([without("reason")])),
            "module.json:1:11: this edit cannot be used: missing field `reason`",
        ),
        ("a null reason", whole(json!([with("reason", Value::Null)])), "`reason` is null"),
        ("no link", whole(json!([edit(), without("link_b")])), "missing field `link_b`"),
        ("a word for a boolean", whole(json!([with("skip", json!("yes"))])), "invalid type"),
        ("an unknown key", whole(json!([with("because", json!("x"))])), "`because`"),
        ("no list", whole(json!({})), "`edits` must be a list"),
        ("null", whole(Value::Null), "`edits` must be a list"),
        ("no edits", "{}".to_owned(), "`edits` is missing"),
        ("twice", format!("{{\"edits\": [{}],\n\"edits\": []}}", edit()), "module.json:2:1: "),
    ];
    for (case, text, words) in cases {
        for metadata in [None, Some("{")] {
            let (_folder, source, target) = edited();
            fs::write(target.join(SKIPS).join("module.json"), &text).unwrap();
            if let Some(metadata) = metadata {
                fs::write(target.join("urdd.json"), metadata).unwrap();
            }
            let before = bytes_below(&target);
            let output = urdd(&["generate", "--samples", "5", "--force", "-o"])
                .arg(&target)
                .arg(&source)
                .output()
                .unwrap();
            assert_eq!(output.status.code(), Some(1), "{case}: {output:?}");
            let said = String::from_utf8(output.stderr).unwrap();
            assert!(said.contains(words), "{case}: {said}");
            assert!(said.contains("--drop-edits"), "{case}: {said}");
            assert!(bytes_below(&target) == before, "{case}: something was written");
            // On purpose.
            let output = urdd(&["generate", "--samples", "5", "--force", "--drop-edits", "-o"])
                .arg(&target)
                .arg(&source)
                .output()
                .unwrap();
            assert!(output.status.success(), "{case}: {output:?}");
            let module = read_json(&target.join(SKIPS).join("module.json"));
            assert_eq!(module["edits"], json!([]), "{case}");
        }
    }
}

#[test]
fn an_edit_of_the_yaml_file_alone_stops_the_run() {
    let (_folder, source, target) = edited();
    generate(&source, &target, &settings(), &()).unwrap();
    let file = target.join(SKIPS).join("module.yaml");
    let text = fs::read_to_string(&file).unwrap();
    let reason = "reason: \"a cable\"";
    assert!(text.contains(reason), "{text}");
    for other in [text.replace(reason, "reason: a longer cable"), text.replace(reason, "reason: [")]
    {
        fs::write(&file, other).unwrap();
        let error = generate(&source, &target, &settings(), &()).unwrap_err();
        assert_eq!(error.code(), "edits");
        let words = error.to_string();
        let line = 1 + text[..text.find(reason).unwrap()].matches('\n').count();
        assert!(words.contains(&format!("module.yaml:{line}:")), "{words}");
    }
    // Another layout has the same meaning.
    fs::write(&file, format!("# mine\n{text}")).unwrap();
    generate(&source, &target, &settings(), &()).unwrap();
}

#[test]
fn modules_without_the_edits_do_not_replace_them() {
    let (_folder, source, target) = edited();
    let before = bytes_below(&target);
    let core = Settings { selection: Selection::parse(["core"]).unwrap(), ..settings() };
    let error = generate(&source, &target, &core, &()).unwrap_err();
    assert_eq!(error.code(), "edits");
    assert!(error.to_string().contains("holds 1 edit"), "{error}");
    assert!(bytes_below(&target) == before);
    // If there are none, nothing is lost.
    write_edits(&target, &json!([]));
    generate(&source, &target, &core, &()).unwrap();
    assert!(!target.join(SKIPS).exists());
}

#[test]
fn edits_of_which_only_the_yaml_file_is_left_stop_the_run() {
    let (_folder, source, target) = edited();
    generate(&source, &target, &settings(), &()).unwrap();
    fs::remove_file(target.join(SKIPS).join("module.json")).unwrap();
    let before = bytes_below(&target);
    let error = generate(&source, &target, &settings(), &()).unwrap_err();
    assert_eq!(error.code(), "edits");
    assert!(error.to_string().contains("module.json is missing"), "{error}");
    assert!(bytes_below(&target) == before);
}

#[test]
fn an_edit_of_a_link_that_never_was_stops_the_run() {
    let (_folder, source, target) = edited();
    let mut mistyped = edit();
    mistyped["link_b"] = json!("B");
    write_edits(&target, &json!([edit(), mistyped]));
    let before = bytes_below(&target);
    let error = generate(&source, &target, &settings(), &()).unwrap_err();
    assert_eq!(error.code(), "edits");
    assert!(error.to_string().contains("names the link `B`"), "{error}");
    assert!(bytes_below(&target) == before);
    // A link that the robot no longer has only leads to a note.
    write_edits(&target, &json!([edit()]));
    fs::write(&source, ROBOT.replace("\"b\"", "\"c\"")).unwrap();
    let made = generate(&source, &target, &settings(), &()).unwrap();
    assert!(made.notes.iter().any(|note| note.to_string().contains("`b`")));
}
