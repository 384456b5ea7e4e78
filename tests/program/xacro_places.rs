//! Places in xacro files, with a program in place of xacro that writes the notes that our modules in it write.
//! `tests/figures/xacro` has them of xacro itself.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

const MAIN: &str = "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
    <xacro:include filename=\"../parts/part.xacro\"/>\n\
    <xacro:part name=\"a\" mass=\"-1\"/>\n\
    </robot>\n";
const PART: &str = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
    <xacro:macro name=\"part\" params=\"name\n  mass:=2\">\n\
    <link name=\"${name}\"><inertial>\n<mass value=\"${mass}\"/><inertia ixx=\"1\"/></inertial></link>\n\
    </xacro:macro>\n</robot>\n";
/// What xacro makes: the elements are those of the notes.
pub const MADE: &str = "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"-1\"/>\
    <inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link></robot>";

/// A folder with a robot in `urdf/`, a macro in `parts/`, and the program: it writes these notes, whose files are main, part
/// and a YAML, says this text, and ends with this status.
pub fn folder(mut notes: Value, said: &str, status: i32) -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let root = folder.path().canonicalize().expect("a folder");
    let files =
        ["urdf/r.urdf.xacro", "parts/part.xacro", "config/y.yaml"].map(|name| root.join(name));
    notes["files"] = json!(files);
    let stream = if status == 0 { "" } else { " >&2" };
    let script = format!(
        "#!/bin/sh\nPATH=/usr/bin:/bin\ncp \"${{0%/*}}/notes\" \"$URDD_XACRO_PLACES\"\ncat \"${{0%/*}}/said\"{stream}\nexit {status}\n"
    );
    for (name, text) in [
        ("urdf/r.urdf.xacro", MAIN),
        ("parts/part.xacro", PART),
        ("config/y.yaml", "# masses\na: -1\n"),
        ("bin/notes", &notes.to_string()),
        ("bin/said", &said.replace("ROOT", &root.display().to_string())),
        ("bin/xacro", &script),
    ] {
        let path = root.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("written");
    }
    let mode = fs::Permissions::from_mode(0o755);
    fs::set_permissions(root.join("bin/xacro"), mode).expect("a program");
    folder
}

fn lint(folder: &Path, form: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["lint", ".", "--xacro", "--format", form])
        .current_dir(folder)
        .env("PATH", folder.join("bin"))
        .output()
        .expect("the program");
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let root = folder.canonicalize().expect("a folder");
    assert!(!text.contains(&*root.to_string_lossy()), "an absolute path: {text}");
    text
}

/// Notes of [`MADE`], of which the mass is from this place.
pub fn notes(value: Value) -> Value {
    json!({
        "elements": [[0, 1, 1, null], [1, 4, 1, 0], [1, 4, 22, 0], [1, 5, 1, 0], [1, 5, 24, 0]],
        "calls": [[[0, 3, 1], "part", null]],
        "values": [[3, "", value], [3, "value", value]],
    })
}

fn mass(folder: &Path) -> Value {
    let report: Value = serde_json::from_str(&lint(folder, "json")).expect("JSON");
    let findings = report["urdds"][0]["findings"].as_array().expect("a list");
    findings.iter().find(|one| one["code"] == "SRC003").expect("it").clone()
}

fn place(file: &str, line: u32, column: u32, name: Option<&str>) -> Value {
    json!({"file": file, "line": line, "column": column, "macro_name": name})
}

#[test]
fn a_value_is_where_its_literal_is() {
    let used_at = place("../parts/part.xacro", 5, 1, Some("part"));
    let call = place("r.urdf.xacro", 3, 1, Some("part"));
    for (value, at) in [
        // An attribute of the call, a line of the YAML, a parameter's default.
        (json!([0, 3, 1, "mass", ""]), place("r.urdf.xacro", 3, 22, None)),
        (json!([2, 2, 4, "", ""]), place("../config/y.yaml", 2, 4, None)),
        (json!([1, 2, 1, "params", "mass"]), place("../parts/part.xacro", 3, 3, Some("part"))),
    ] {
        let folder = folder(notes(value), MADE, 0);
        let found = mass(folder.path());
        let written = &found["places"][0]["written_at"];
        for key in ["file", "line", "column"] {
            assert_eq!((&found[key], &written[key]), (&at[key], &at[key]), "{key}: {found}");
        }
        assert_eq!(written["macro_name"], at["macro_name"]);
        assert_eq!((&written["used_at"], &written["calls"]), (&used_at, &json!([call])));
    }
}

#[test]
fn without_a_literal_the_place_is_the_element() {
    let mut notes = notes(Value::Null);
    notes["values"] = json!([]);
    let folder = folder(notes, MADE, 0);
    let found = mass(folder.path());
    assert_eq!((&found["file"], &found["line"]), (&json!("../parts/part.xacro"), &json!(5)));
    let written = &found["places"][0]["written_at"];
    assert_eq!((&written["used_at"], &written["calls"][0]["line"]), (&Value::Null, &json!(3)));
}

#[test]
fn every_form_has_the_trail() {
    let folder = folder(notes(json!([2, 2, 4, "", ""])), MADE, 0);
    let by = "by ../parts/part.xacro:5:1 in the macro \"part\", called at r.urdf.xacro:3:1";
    let human = lint(folder.path(), "human");
    assert!(human.contains(&format!("at ../config/y.yaml:2:4 (link `a`), {by}\n")), "{human}");
    let github = lint(folder.path(), "github");
    assert!(github.contains("file=config/y.yaml,line=2,col=4,title=SRC003"), "{github}");
    assert!(github.contains(&format!("; trail: {by}")), "{github}");
    let sarif: Value = serde_json::from_str(&lint(folder.path(), "sarif")).expect("JSON");
    let results = sarif["runs"][0]["results"].as_array().expect("a list");
    let result = results.iter().find(|one| one["ruleId"] == "SRC003").expect("it");
    let shown = |location: &Value| {
        let physical = &location["physicalLocation"];
        let line = physical["region"]["startLine"].as_u64().expect("a line");
        let file = physical["artifactLocation"]["uri"].as_str().expect("a file");
        format!("{file}:{line} {}", location["message"]["text"].as_str().unwrap_or_default())
    };
    assert_eq!(shown(&result["locations"][0]), "config/y.yaml:2 ");
    let related = result["relatedLocations"].as_array().expect("a list");
    let related: Vec<String> = related.iter().map(shown).collect();
    assert_eq!(
        related,
        [
            "parts/part.xacro:5 The value is used here, in the macro `part`",
            "urdf/r.urdf.xacro:3 The macro `part` is called here",
        ]
    );
}

/// A loop is a macro that calls itself.
#[test]
fn of_many_calls_the_innermost_and_the_outermost_are_named() {
    let mut notes = notes(json!([2, 2, 4, "", ""]));
    let call = |number: u32| match number {
        0 => json!([[0, 3, 1], "part", null]),
        _ => json!([[1, 4, 22], "part", number - 1]),
    };
    notes["calls"] = (0..100).map(call).collect();
    notes["elements"][3][3] = json!(99);
    let folder = folder(notes, MADE, 0);
    let found = mass(folder.path());
    let calls = found["places"][0]["written_at"]["calls"].as_array().expect("a list").clone();
    assert_eq!((calls.len(), &calls[0]["line"], &calls[15]["line"]), (16, &json!(4), &json!(3)));
    let human = lint(folder.path(), "human");
    let part = "called at ../parts/part.xacro:4:22";
    let trail = format!("{part}, {part}, by 13 other calls, called at r.urdf.xacro:3:1\n");
    assert!(human.contains(&trail), "{human}");
}

/// What a stranger's program notes may be anything.
#[test]
fn notes_that_are_not_ours_do_no_harm() {
    for (key, value) in [
        ("calls", json!([[[0, 3, 1], "part", 0]])),
        ("calls", json!([[[9, 3, 1], "part", 7]])),
        ("values", json!([[3, "", [9, 1, 1, "", ""]]])),
        ("values", json!([[99, "", [0, 99, 99, "x", "y"]]])),
        ("elements", json!([])),
        ("values", json!("x")),
    ] {
        let mut notes = notes(json!([1, 2, 1, "params", "none"]));
        notes[key] = value;
        let folder = folder(notes, MADE, 0);
        assert_eq!(mass(folder.path())["code"], "SRC003");
    }
}

#[test]
fn a_robot_that_cannot_be_made_has_its_innermost_place() {
    let said = "error: Undefined parameters [size]\n\
        when instantiating macro: part (ROOT/urdf/../parts/part.xacro)\n\
        in file: ROOT/urdf/r.urdf.xacro\n";
    let notes = |place: Value, call: Value| json!({"elements": [], "calls": [[[0, 3, 1], "part", null]], "fault": [place, call]});
    let reason = |notes: Value| {
        let folder = folder(notes, said, 2);
        let report: Value = serde_json::from_str(&lint(folder.path(), "json")).expect("JSON");
        report["urdds"][0]["reason"].as_str().expect("a reason").to_owned()
    };
    assert_eq!(
        reason(notes(json!([0, 3, 1, "", ""]), Value::Null)),
        "./urdf/r.urdf.xacro:3:1: `xacro` could not expand it: error: Undefined parameters [size]"
    );
    assert_eq!(
        reason(notes(json!([1, 5, 1, "value", ""]), json!(0))),
        "./parts/part.xacro:5:7: `xacro` could not expand ./urdf/r.urdf.xacro: error: Undefined parameters [size]; \
         by the macro `part`, called at ./urdf/r.urdf.xacro:3:1"
    );
    // Without a place, what xacro says of it stays.
    assert_eq!(
        reason(json!({})),
        "./urdf/r.urdf.xacro: `xacro` could not expand it: error: Undefined parameters [size]; \
         when instantiating macro: part (./urdf/../parts/part.xacro); in file: ./urdf/r.urdf.xacro"
    );
}

#[test]
fn a_text_in_many_variants_is_told_once() {
    let folder = folder(notes(json!([0, 3, 1, "mass", ""])), MADE, 0);
    let root = folder.path();
    let variants =
        "[[robot]]\npath = \"urdf/r.urdf.xacro\"\nargs = { side = [\"a\", \"b\", \"c\", \"d\"] }\n";
    fs::write(root.join("urdd.toml"), variants).expect("written");
    let taken = format!("{MAIN}<!-- $(arg side) -->\n");
    fs::write(root.join("urdf/r.urdf.xacro"), taken).expect("written");
    let github = lint(root, "github");
    let told: Vec<&str> = github.lines().filter(|line| line.contains("title=SRC003")).collect();
    assert_eq!(told.len(), 1, "{github}");
    assert!(told[0].ends_with("; in 4 variants: side:=a, side:=b, side:=c, …"), "{github}");
    let sarif: Value = serde_json::from_str(&lint(root, "sarif")).expect("JSON");
    let results = sarif["runs"][0]["results"].as_array().expect("a list");
    let results: Vec<&Value> = results.iter().filter(|one| one["ruleId"] == "SRC003").collect();
    assert_eq!((results.len(), &results[0]["occurrenceCount"]), (1, &json!(4)));
    let text = results[0]["message"]["text"].as_str().expect("a text");
    assert!(text.contains("\nIn: 4 variants: side:=a, side:=b, side:=c, …"), "{text}");
    // Programs still have each of them.
    let report: Value = serde_json::from_str(&lint(root, "json")).expect("JSON");
    let urdds = report["urdds"].as_array().expect("a list");
    let is_it = |one: &&Value| one["code"] == "SRC003";
    let has_it =
        |urdd: &Value| urdd["findings"].as_array().expect("a list").iter().any(|one| is_it(&one));
    assert_eq!(urdds.iter().filter(|urdd| has_it(urdd)).count(), 4);
    assert_eq!(lint(root, "junit").matches("mass is negative").count() % 4, 0);

    // People see it at the first of few.
    fs::write(root.join("urdd.toml"), variants.replace(", \"c\", \"d\"", "")).expect("written");
    let human = lint(root, "human");
    assert_eq!(human.matches("warning SRC003").count(), 1, "{human}");
    assert!(human.contains("      in 2 variants: side:=a, side:=b\n"), "{human}");
    assert!(human.contains(" as of urdf/r.urdf.xacro side:=a\n"), "{human}");
}

/// xacro passes over it, and makes the robot of the defaults.
#[test]
fn a_declared_argument_that_no_file_takes_is_refused_by_every_command() {
    let folder = folder(notes(json!([0, 3, 1, "mass", ""])), MADE, 0);
    let root = folder.path();
    let robots = "[[robot]]\npath = \"urdf/r.urdf.xacro\"\nargs = { side = \"a\" }\n";
    fs::write(root.join("urdd.toml"), robots).expect("written");
    let file = "urdf/r.urdf.xacro";
    let run = |words: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        let output = command.args(words).current_dir(root).env("PATH", root.join("bin")).output();
        let output = output.expect("the program");
        let said = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8(said).expect("UTF-8"))
    };
    let commands: [&[&str]; 4] = [
        &["lint", file],
        &["generate", file, "-o", "made"],
        &["view", file, "--export", "site"],
        &["diff", file, file],
    ];
    for words in commands {
        let (status, said) = run(words);
        assert!(matches!(status, Some(1 | 2)), "{words:?}: {said}");
        let wanted = "urdd.toml gives the argument `side`, which no file of the robot takes";
        assert!(said.contains(wanted), "{words:?}: {said}");
    }
    // An older version of the file need not take what the newer one does, and neither what somebody types.
    fs::copy(root.join(file), root.join("urdf/old.urdf.xacro")).expect("copied");
    fs::write(root.join(file), format!("{MAIN}<!-- $(arg side) -->\n")).expect("written");
    for words in [&["diff", "urdf/old.urdf.xacro", file][..], &["diff", file, file, "other:=1"]] {
        let (status, said) = run(words);
        assert_eq!(status, Some(0), "{words:?}: {said}");
    }
}
