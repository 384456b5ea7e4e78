//! `urdd validate` as people and scripts meet it: exit status, reports, settings, and the same bytes
//! for the same input.

mod support;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};
use support::fixture::{Fixture, ROOT};

/// Runs `urdd validate` in a folder.
fn validate(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("the program")
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.arg("validate").args(arguments).current_dir(folder);
    command
}

fn status(folder: &Path, arguments: &[&str]) -> i32 {
    let output = validate(folder, arguments);
    output.status.code().expect("an exit status")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn report(folder: &Path, arguments: &[&str]) -> Value {
    let output = validate(folder, &[&["--format", "json"], arguments].concat());
    serde_json::from_slice(&output.stdout).unwrap_or_else(|e| panic!("{e}: {}", stderr(&output)))
}

/// A folder with URDDs: `good`, `bad` (an error), and `odd` (a warning).
fn collection() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, change: &dyn Fn(&mut Fixture)| {
        let mut toy = Fixture::toy();
        change(&mut toy);
        toy.seal();
        toy.write_to(&folder.path().join(name));
    };
    write("good", &|_| {});
    write("bad", &|f| f.set(ROOT, "/robot_name", json!("other")));
    write("odd", &|f| {
        f.remove_file("dof_module/module.yaml");
        f.unlist("dof_module/module.yaml");
    });
    folder
}

#[test]
fn exit_statuses() {
    let folder = collection();
    let status = |arguments: &[&str]| status(folder.path(), arguments);
    assert_eq!(status(&["good"]), 0);
    assert_eq!(status(&["odd"]), 0);
    assert_eq!(status(&["bad"]), 1);
    assert_eq!(status(&["."]), 1);
    assert_eq!(status(&["good", "bad"]), 1);
    assert_eq!(status(&["nowhere"]), 2);
    assert_eq!(status(&["good", "nowhere"]), 2);
    assert_eq!(status(&["good/urdd.json"]), 2);
    assert_eq!(status(&[]), 2);
    assert_eq!(status(&["good", "--no-such-flag"]), 2);
    assert_eq!(status(&["good", "--with-crashing-rule"]), 101);
    assert_eq!(status(&["bad", "--with-crashing-rule"]), 101);
}

#[test]
fn fail_on() {
    let folder = collection();
    let status = |name, severity| status(folder.path(), &[name, "--fail-on", severity]);
    assert_eq!(status("odd", "warning"), 1);
    assert_eq!(status("odd", "info"), 1);
    assert_eq!(status("odd", "error"), 0);
    assert_eq!(status("good", "info"), 0);
    assert_eq!(status("good", "fatal"), 2);
}

#[test]
fn class() {
    let folder = collection();
    let mut core = Fixture::toy();
    for (module, class) in [
        ("original_meshes_module", "Geometry"),
        ("link_shapes_skips_module", "Core"),
    ] {
        core.remove_module(module);
        core.set(ROOT, "/conformance_class", json!(class));
    }
    for kind in [
        "link_shapes_simple_skips_module",
        "link_shapes_distance_statistics_module",
        "link_shapes_max_distance_from_origin_module",
        "link_shapes_approximations_module",
        "convex_decomposition_meshes_module",
        "convex_hull_meshes_module",
        "plain_meshes_module",
    ] {
        core.remove_module(kind);
    }
    core.seal();
    core.write_to(&folder.path().join("core"));
    let status = |arguments: &[&str]| status(folder.path(), arguments);
    assert_eq!(status(&["core"]), 0);
    assert_eq!(status(&["core", "--class", "core"]), 0);
    assert_eq!(status(&["core", "--class", "Shapes"]), 1);
    assert_eq!(status(&["core", "--class", "huge"]), 2);
    let report = report(folder.path(), &["core", "--class", "geometry"]);
    let finding = &report["urdds"][0]["findings"][0];
    assert_eq!(
        (&finding["code"], &finding["count"]),
        (&json!("DIR019"), &json!(4))
    );
}

#[test]
fn crashes_are_told() {
    let folder = collection();
    let output = validate(folder.path(), &["good", "--with-crashing-rule"]);
    assert!(
        stdout(&output).contains("INCOMPLETE"),
        "{}",
        stdout(&output)
    );
    assert!(stdout(&output).contains("TST001"));
    assert_eq!(stderr(&output), "");
    let report = report(folder.path(), &["good", "--with-crashing-rule"]);
    assert_eq!(report["urdds"][0]["verdict"], "incomplete");
}

#[test]
fn json_reports_fit_their_schema() {
    let folder = collection();
    let schema =
        serde_json::to_value(schemars::schema_for!(urdd::report::Report)).expect("a value");
    let schema = jsonschema::draft202012::new(&schema).expect("a schema");
    for arguments in [
        &["."] as &[&str],
        &["good"],
        &["bad", "--with-crashing-rule"],
    ] {
        let report = report(folder.path(), arguments);
        let errors: Vec<String> = schema.iter_errors(&report).map(|e| e.to_string()).collect();
        assert_eq!(errors, [""; 0]);
    }
    let report = report(folder.path(), &["."]);
    let verdicts: Vec<(&Value, &Value)> = report["urdds"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|urdd| (&urdd["path"], &urdd["verdict"]))
        .collect();
    let expected = [("bad", "fail"), ("good", "pass"), ("odd", "pass")];
    let expected = expected.map(|(path, verdict)| (json!(path), json!(verdict)));
    assert!(
        verdicts
            .iter()
            .map(|(p, v)| (*p, *v))
            .eq(expected.iter().map(|(p, v)| (p, v)))
    );
    assert_eq!(
        report["totals"],
        json!({"urdds": 3, "error": 1, "warning": 1, "info": 0})
    );
}

#[test]
fn a_report_file_beside_the_text() {
    let folder = collection();
    let output = validate(folder.path(), &["bad", "--output", "report.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("DIR020"));
    let file = fs::read_to_string(folder.path().join("report.json")).expect("a report");
    let written: Value = serde_json::from_str(&file).expect("JSON");
    assert_eq!(written, report(folder.path(), &["bad"]));
    assert_eq!(
        status(folder.path(), &["good", "--output", "no/such/folder.json"]),
        2
    );
}

#[test]
fn settings() {
    let folder = collection();
    let with = |text: &str, arguments: &[&str]| {
        fs::write(folder.path().join("urdd.toml"), text).expect("written");
        validate(folder.path(), arguments)
    };
    for (wrong, part) in [
        ("colour = true", "colour"),
        ("[severity]\nDIR999 = \"info\"", "DIR999"),
        ("[severity]\nDIR020 = \"fatal\"", "fatal"),
        ("class = \"huge\"", "huge"),
        ("[[ignore]]\ncode = \"DIR020\"\npath = \"**\"", "reason"),
        (
            "[[ignore]]\ncode = \"DIR020\"\npath = \"**\"\nreason = \" \"",
            "reason",
        ),
        (
            "[[ignore]]\ncode = \"DIR020\"\npath = \"[\"\nreason = \"x\"",
            "pattern",
        ),
        ("fail-on = ", "urdd.toml"),
    ] {
        let output = with(wrong, &["good"]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
        assert!(
            stderr(&output).contains(part),
            "{wrong}: {}",
            stderr(&output)
        );
        assert!(
            stderr(&output).contains("urdd.toml"),
            "{wrong}: {}",
            stderr(&output)
        );
    }
    let status = |text: &str, arguments: &[&str]| with(text, arguments).status.code();
    assert_eq!(
        status("[severity]\nDIR020 = \"warning\"", &["bad"]),
        Some(0)
    );
    assert_eq!(status("[severity]\nDIR010 = \"error\"", &["odd"]), Some(1));
    assert_eq!(status("fail-on = \"warning\"", &["odd"]), Some(1));
    assert_eq!(
        status("fail-on = \"warning\"", &["odd", "--fail-on", "error"]),
        Some(0)
    );

    let ignore = "[[ignore]]\ncode = \"DIR020\"\npath = \"bad/*\"\nreason = \"renamed soon\"\n";
    let output = with(ignore, &["."]);
    assert_eq!(output.status.code(), Some(0), "{}", stdout(&output));
    let checks = report(folder.path(), &["."]);
    let checks = checks["urdds"][0]["checks"]
        .as_array()
        .expect("a list")
        .clone();
    let check = checks
        .iter()
        .find(|check| check["code"] == "DIR020")
        .expect("a check");
    assert_eq!(check["reason"], "ignored by the settings: renamed soon");
    // Of another URDD: it matches nothing, and that is told.
    let output = with(&ignore.replace("bad/", "ba/"), &["."]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stdout(&output).contains("`ba/*`"), "{}", stdout(&output));
    assert_eq!(
        report(folder.path(), &["."])["stale_ignores"][0]["code"],
        "DIR020"
    );

    fs::remove_file(folder.path().join("urdd.toml")).expect("removed");
    fs::write(folder.path().join("ours.toml"), ignore).expect("written");
    let arguments = ["bad", "--config", "ours.toml"];
    assert_eq!(validate(folder.path(), &arguments).status.code(), Some(0));
    let arguments = ["bad", "--config", "nowhere.toml"];
    assert_eq!(validate(folder.path(), &arguments).status.code(), Some(2));
}

#[test]
fn same_input_same_bytes() {
    let (folder, other) = (collection(), tempfile::tempdir().expect("a folder"));
    let copy = other.path().join("deeper/down");
    copy_folder(folder.path(), &copy);
    for format in ["json", "human"] {
        let run = |folder: &Path, threads: &str| {
            let mut command = command(folder, &[".", "--format", format]);
            command
                .env("RAYON_NUM_THREADS", threads)
                .output()
                .expect("the program")
                .stdout
        };
        let first = run(folder.path(), "1");
        assert!(!first.is_empty());
        assert!(
            first == run(folder.path(), "2"),
            "{format}: with two threads"
        );
        assert!(first == run(&copy, "2"), "{format}: in another folder");
    }
    let by_path = |path: &Path| {
        let path = path.join("bad");
        validate(
            folder.path(),
            &["--format", "json", path.to_str().expect("UTF-8")],
        )
        .stdout
    };
    assert!(by_path(folder.path()) == by_path(&copy), "by absolute path");
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        match entry.path().is_dir() {
            true => copy_folder(&entry.path(), &target),
            false => {
                fs::copy(entry.path(), target).expect("copied");
            }
        }
    }
}

#[test]
fn rehash_brings_sizes_and_hashes_up_to_date_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path().join("robot");
    let mut toy = Fixture::toy();
    toy.seal();
    toy.write_to(&root);
    let rehash = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command
            .args(["rehash", "robot"])
            .current_dir(folder.path())
            .output()
            .expect("the program")
    };
    let metadata = || fs::read(root.join(ROOT)).expect("urdd.json");
    let before = metadata();
    assert_eq!(stdout(&rehash()), "robot: up to date\n");
    assert_eq!(metadata(), before);

    // White space changes no document, but every size and hash.
    let module = root.join("dof_module/module.json");
    let text = fs::read_to_string(&module).expect("module.json");
    fs::write(&module, text + "\n").expect("written");
    assert_eq!(status(folder.path(), &["robot"]), 1);
    assert_eq!(
        stdout(&rehash()),
        "robot: brought up to date\n  dof_module/module.json\n"
    );
    assert_eq!(status(folder.path(), &["robot"]), 0);

    fs::remove_file(root.join("dof_module/VERSION")).expect("removed");
    let now = metadata();
    let output = rehash();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("dof_module/VERSION: there is no such file"),
        "{}",
        stderr(&output)
    );
    assert_eq!(metadata(), now);
}
