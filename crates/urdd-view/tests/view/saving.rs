//! Saving skips.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use urdd_validate::settings::Settings;

use super::asking::Running;
use testkit::robots::made_named;

const FOLDER: &str = "link_shapes_modules/link_shapes_skips_module";

/// Every file with its content.
fn content(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(at) = waiting.pop() {
        for entry in fs::read_dir(at).expect("a folder") {
            let path = entry.expect("an entry").path();
            match path.is_dir() {
                true => waiting.push(path),
                false => {
                    let bytes = fs::read(&path).expect("a file");
                    found.insert(path.strip_prefix(folder).expect("below").to_owned(), bytes);
                }
            }
        }
    }
    found
}

fn findings(path: &Path) -> usize {
    let run = urdd_validate::validate(&[path], &Settings::default()).expect("a run");
    run.report.urdds.iter().map(|urdd| urdd.findings.len()).sum()
}

fn edits() -> Value {
    json!([{ "link_a": "torch", "link_b": "turret", "skip": true, "reason": "the cell's fence <b>" }])
}

#[test]
fn a_saved_urdd_passes_and_undo_restores_its_bytes() {
    let (_folder, path) = made_named("welding_arm");
    fs::write(path.join("notes.txt"), "mine").expect("written");
    let server = Running::on(&path);
    let before = content(&path);
    let errors = findings(&path);
    let revision = server.json("/robots/welding_arm/files.json")["revision"].clone();
    let wish = json!({ "revision": revision, "edits": edits() });
    let answer = server.post("/robots/welding_arm/skips", &wish);
    assert_eq!(answer.status, 200, "{}", answer.text());
    let saved: Value = serde_json::from_slice(&answer.body).expect("JSON");

    let after = content(&path);
    let changed: Vec<&Path> = after
        .iter()
        .filter(|(name, bytes)| before.get(*name) != Some(bytes))
        .map(|(name, _)| name.as_path())
        .collect();
    let module = |name: &str| PathBuf::from(format!("{FOLDER}/{name}"));
    let expected = [module("module.json"), module("module.yaml"), "urdd.json".into()];
    assert_eq!(changed, expected);
    assert_eq!(before.keys().collect::<Vec<_>>(), after.keys().collect::<Vec<_>>());
    assert_eq!(findings(&path), errors, "it is as sound as before");
    let text = fs::read_to_string(path.join(FOLDER).join("module.json")).expect("a file");
    let document: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(document["edits"], edits());

    let wish = json!({ "revision": saved["revision"], "undo": true });
    let answer = server.post("/robots/welding_arm/skips", &wish);
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(content(&path), before);
    let again: Value = serde_json::from_slice(&answer.body).expect("JSON");
    let wish = json!({ "revision": again["revision"], "undo": true });
    assert_eq!(server.post("/robots/welding_arm/skips", &wish).status, 409);
}

#[test]
fn what_changed_on_disk_is_not_overwritten() {
    let (_folder, path) = made_named("welding_arm");
    let server = Running::on(&path);
    let revision = server.json("/robots/welding_arm/files.json")["revision"].clone();
    fs::write(path.join("notes.txt"), "written meanwhile").expect("written");
    let before = content(&path);
    let wish = json!({ "revision": revision, "edits": edits() });
    let answer = server.post("/robots/welding_arm/skips", &wish);
    assert_eq!(answer.status, 409, "{}", answer.text());
    assert_eq!(content(&path), before);
}

/// An editor that keeps the file time, or a program that sets it back.
#[cfg(unix)]
#[test]
fn a_change_that_keeps_size_and_time_is_not_overwritten() {
    let (_folder, path) = made_named("welding_arm");
    let file = path.join(FOLDER).join("module.json");
    let text = fs::read_to_string(&file).expect("a file");
    let time = fs::metadata(&file).and_then(|metadata| metadata.modified()).expect("a time");
    let server = Running::on(&path);
    let revision = server.json("/robots/welding_arm/files.json")["revision"].clone();
    let changed = text.replacen("true", "null", 1).replacen("false", "true ", 1);
    assert!(changed != text && changed.len() == text.len());
    fs::write(&file, &changed).expect("written");
    let written = fs::File::options().write(true).open(&file).expect("it");
    written.set_modified(time).expect("set");
    let wish = json!({ "revision": revision, "edits": edits() });
    let answer = server.post("/robots/welding_arm/skips", &wish);
    assert_eq!(answer.status, 409, "{}", answer.text());
    assert_eq!(fs::read_to_string(&file).expect("a file"), changed);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let (_folder, path) = made_named("welding_arm");
    let server = Running::on(&path);
    let before = content(&path);
    let revision = server.json("/robots/welding_arm/files.json")["revision"].clone();
    let unknown = json!([{ "link_a": "torhc", "link_b": "turret", "skip": true, "reason": "" }]);
    for (wish, status) in [
        (json!({ "revision": revision, "edits": unknown }), 400),
        (json!({ "revision": revision, "edits": [1] }), 400),
        (json!({ "revision": revision, "edits": edits(), "more": 1 }), 400),
        (json!([]), 400),
        (json!({ "revision": "gone", "edits": edits() }), 409),
    ] {
        let answer = server.post("/robots/welding_arm/skips", &wish);
        assert_eq!(answer.status, status, "{wish}: {}", answer.text());
    }
    let wish = json!({ "revision": revision, "edits": unknown });
    let answer = server.post("/robots/welding_arm/skips", &wish);
    assert!(answer.text().contains("did you mean `torch`"), "{}", answer.text());
    assert_eq!(content(&path), before);
}

/// The pose of the page becomes a named configuration, which the validator takes; nothing of a person's is replaced unasked.
#[test]
fn a_pose_is_saved_under_a_name() {
    let (_folder, path) = made_named("welding_arm");
    let server = Running::on(&path);
    let post = |wish: &Value| server.post("/robots/welding_arm/configurations", wish);
    let revision = || server.json("/robots/welding_arm/files.json")["revision"].clone();
    let robot = urdd_robot::Robot::open(&path).expect("a robot");
    let middle = robot.configurations().expect("bounds").middle();
    let zero = robot.configurations().expect("bounds").zero();
    let wish =
        |name: &str, q: &[f64]| json!({ "revision": revision(), "name": name, "configuration": q });
    let answer = post(&wish("home <b>", &middle));
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(findings(&path), 0);
    let saved = |name: &str| {
        let robot = urdd_robot::Robot::open(&path).expect("a robot");
        robot.named_configuration(name).expect("a configuration").to_vec()
    };
    assert_eq!(saved("home <b>"), middle);
    let before = content(&path);
    for (wish, status) in [
        (wish("home <b>", &zero), 409),
        (wish("", &zero), 400),
        (wish("short", &zero[1..]), 400),
        (wish("far", &vec![1e9; zero.len()]), 400),
        (json!({ "revision": "gone", "name": "x", "configuration": zero }), 409),
        (json!({ "revision": revision(), "name": "x" }), 400),
    ] {
        let answer = post(&wish);
        assert_eq!(answer.status, status, "{wish}: {}", answer.text());
    }
    assert_eq!(content(&path), before);
    let mut replacing = wish("home <b>", &zero);
    replacing["replace"] = json!(true);
    assert_eq!(post(&replacing).status, 200);
    assert_eq!(saved("home <b>"), zero);
}
