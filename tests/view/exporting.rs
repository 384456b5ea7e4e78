//! The static site.

use std::fs;

use serde_json::Value;
use urdd::cancellation::Cancellation;
use urdd::view::{Collection, ExportError, export, may_hold_page, page_with};

use super::asking::made;

#[test]
fn a_site_holds_the_page_and_the_robots() {
    let (folder, path) = made("welding_arm");
    let mut collection = Collection::default();
    collection.add(&path).expect("a URDD");
    let site = folder.path().join("site");
    let mut told = Vec::new();
    let mut tell = |robot: &urdd::view::Shown| told.push(robot.id.clone());
    for _ in 0..2 {
        export(&collection, &site, &Cancellation::default(), &mut tell).expect("written");
    }
    assert_eq!(told, ["welding_arm", "welding_arm"]);
    let page = fs::read_to_string(site.join("index.html")).expect("a page");
    assert!(page.contains(r#"content="static""#), "{page}");
    let module = fs::read(site.join("urdd.wasm")).expect("the module");
    assert!(module.starts_with(b"\0asm"));
    let json = |name: &str| -> Value {
        let text = fs::read_to_string(site.join(name)).expect(name);
        serde_json::from_str(&text).expect("JSON")
    };
    let robots = json("robots.json");
    assert_eq!(robots[0]["verdict"], "pass");
    assert_eq!(robots[0]["links"], 9);
    assert_eq!(robots[0]["writable"], false);
    let listed = json("robots/welding_arm/files.json");
    for file in listed["files"].as_array().expect("a list") {
        let name = file["path"].as_str().expect("a path");
        let copy = fs::read(site.join("robots/welding_arm/files").join(name)).expect(name);
        assert_eq!(copy, fs::read(path.join(name)).expect(name), "{name}");
    }
}

#[test]
fn one_file_holds_all_and_its_policy_knows_it() {
    let (_folder, path) = made("gripper");
    let mut collection = Collection::default();
    collection.add(&path).expect("a URDD");
    let page = page_with(&collection.robots()[0]).expect("a page");
    assert!(page.contains(r#"content="inline""#));
    for carried in [
        "robots.json",
        "report.json",
        "robot.zip",
        "worker.js",
        "urdd.wasm",
    ] {
        assert!(
            page.contains(&format!(r#"<script type="text/plain" id="{carried}">"#)),
            "{carried}"
        );
    }
    assert!(!page.contains("src=\"app.js\"") && !page.contains("href=\"style.css\""));
    assert_eq!(page.matches("'unsafe-inline'").count(), 0);
    assert_eq!(page.matches("'sha256-").count(), 2);
}

#[test]
fn a_page_takes_the_place_of_a_page_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("robot.html");
    assert!(may_hold_page(&file), "nothing is there");
    for (text, may) in [
        ("", true),
        ("<!doctype html><title>mine</title>", false),
        ("<meta name=\"urdd-mode\" content=\"served\" />", false),
        (
            "<head>\n<meta name=\"urdd-mode\" content=\"inline\" />",
            true,
        ),
    ] {
        fs::write(&file, text).expect("written");
        assert_eq!(may_hold_page(&file), may, "{text}");
    }
}

#[test]
fn a_folder_with_something_else_is_left_alone() {
    let (folder, path) = made("gripper");
    let mut collection = Collection::default();
    collection.add(&path).expect("a URDD");
    let site = folder.path().join("site");
    fs::create_dir(&site).expect("a folder");
    fs::write(site.join("mine"), "mine").expect("written");
    let result = export(&collection, &site, &Cancellation::default(), &mut |_| {});
    assert!(
        matches!(result, Err(ExportError::Occupied(_))),
        "{result:?}"
    );
    assert_eq!(
        fs::read_to_string(site.join("mine")).expect("it stays"),
        "mine"
    );
}
