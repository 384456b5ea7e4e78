//! Robots that are generated while the page is open, and saving them.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use serde_json::{Value, json};
use urdd_validate::settings::Settings;
use urdd_view::{Collection, Making, Shown, Source};

use super::asking::Running;
use testkit::robots::made_named;

/// A server that shows a generated URDD.
fn generated(path: &Path) -> (Running, Arc<Shown>) {
    let collection = Collection::default();
    let source =
        Source { file: path.with_extension("urdf"), packages: Vec::new(), arguments: Vec::new() };
    let shown = collection.add_source("gripper".to_owned(), source);
    (Running::with(collection), shown)
}

#[test]
fn the_page_hears_how_far_it_is() {
    let (_folder, path) = made_named("gripper");
    let (server, shown) = generated(&path);
    shown.set_making(Making::Running { what: "dof_module".to_owned(), done: 3, of: 15 });
    let entry = || server.json("/robots.json")[0].clone();
    let expected = json!({ "what": "dof_module", "done": 3, "of": 15 });
    assert_eq!(entry()["making"], expected);
    assert_eq!(entry()["temporary"], true);
    shown.set_making(Making::Failed("no link".to_owned()));
    assert_eq!(entry()["failure"], "no link");
    let notes = vec!["a mass was assumed".to_owned()];
    shown.show(path, notes, Making::Done);
    assert_eq!(entry()["notes"], json!(["a mass was assumed"]));
    assert_eq!((&entry()["making"], &entry()["failure"]), (&Value::Null, &Value::Null));
}

#[test]
fn a_generated_urdd_is_saved_once_and_passes() {
    let (folder, path) = made_named("gripper");
    let (server, shown) = generated(&path);
    let running = Making::Running { what: "dof_module".to_owned(), done: 3, of: 15 };
    shown.show(path.clone(), Vec::new(), running);
    let wish = json!({ "folder": folder.path().join("early").to_str() });
    let early = server.post("/robots/gripper/keep", &wish);
    assert_eq!(early.status, 409, "{}", early.text());
    assert!(early.text().contains("still being generated"));
    assert!(!folder.path().join("early").exists());
    shown.show(path.clone(), Vec::new(), Making::Done);
    let skips = json!({ "revision": "x", "edits": [] });
    assert_eq!(server.post("/robots/gripper/skips", &skips).status, 403);
    let target = folder.path().join("new/another_name");
    let wish = json!({ "folder": target.to_str() });
    let answer = server.post("/robots/gripper/keep", &wish);
    assert_eq!(answer.status, 200, "{}", answer.text());
    let run = urdd_validate::validate(&[&target], &Settings::default()).expect("a run");
    assert_eq!(run.report.urdds[0].findings.len(), 0);
    let revision = || server.json("/robots/gripper/files.json")["revision"].clone();
    let saved: Value = serde_json::from_slice(&answer.body).expect("JSON");
    assert_eq!(saved["revision"], revision());
    // From now on, that folder is shown and written to.
    fs::remove_dir_all(&path).expect("removed");
    let entry = server.json("/robots.json")[0].clone();
    assert_eq!((&entry["temporary"], &entry["writable"]), (&json!(false), &json!(true)));
    let skips = json!({ "revision": revision(), "edits": [] });
    let answer = server.post("/robots/gripper/skips", &skips);
    assert_eq!(answer.status, 200, "{}", answer.text());
    assert_eq!(server.post("/robots/gripper/keep", &wish).status, 403);
}

#[test]
fn nothing_is_overwritten() {
    let (folder, path) = made_named("gripper");
    let (server, shown) = generated(&path);
    shown.show(path.clone(), Vec::new(), Making::Done);
    let (full, file) = (folder.path().join("full"), folder.path().join("file"));
    fs::create_dir(&full).expect("a folder");
    fs::write(full.join("mine"), "mine").expect("written");
    fs::write(&file, "mine").expect("written");
    let said = |place: &str| server.post("/robots/gripper/keep", &json!({ "folder": place }));
    for (place, status, words) in [
        (full.to_str(), 409, "not empty"),
        (path.to_str(), 409, "this folder has a URDD already"),
        (file.to_str(), 403, "a file of that name"),
        (Some("  "), 400, "give a folder"),
        (Some("a\0b"), 400, "give a folder"),
    ] {
        let place = place.expect("UTF-8");
        let answer = said(place);
        assert_eq!(answer.status, status, "{place}: {}", answer.text());
        assert!(answer.text().contains(words), "{}", answer.text());
    }
    assert_eq!(fs::read_to_string(full.join("mine")).expect("there"), "mine");
    assert_eq!(fs::read_dir(&full).expect("a folder").count(), 1);
    // Without the token, nothing can be saved.
    let free = folder.path().join("free");
    let wish = json!({ "folder": free.to_str() }).to_string();
    let headers = [("Host", &*server.host())];
    let answer = server.raw("POST /robots/gripper/keep", &headers, wish.as_bytes());
    assert_eq!(answer.status, 403);
    assert!(!free.exists());
}

#[test]
fn a_picture_and_what_the_gallery_says() {
    let (_folder, path) = made_named("welding_arm");
    let server = Running::on(&path);
    let picture = server.get("/robots/welding_arm/picture.png");
    assert_eq!((picture.status, picture.header("content-type")), (200, Some("image/png")));
    assert_eq!(&picture.body[..8], b"\x89PNG\r\n\x1a\n");
    assert!(picture.body.len() < 60_000, "{} bytes", picture.body.len());
    assert_eq!(picture.body, server.get("/robots/welding_arm/picture.png").body);
    let entry = server.json("/robots/welding_arm/summary.json");
    assert_eq!((&entry["links"], &entry["dofs"]), (&json!(9), &json!(6)));
    assert_eq!(entry["verdict"], "pass");
    fs::remove_dir_all(path.join("mesh_modules")).expect("removed");
    // It is drawn of the shapes of the URDF then.
    assert_eq!(server.get("/robots/welding_arm/picture.png").status, 200);
    assert_eq!(server.json("/robots/welding_arm/summary.json")["verdict"], "fail");
}
