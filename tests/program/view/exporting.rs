//! The page with one robot in a single file.

use std::fs;
use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use urdd::view::{Collection, may_hold_page, page_with};
use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_directory::source::Archive;
use urdd_robot::{Robot, ShapeKind};

use super::asking::made;

#[test]
fn one_file_holds_all_and_its_policy_knows_it() {
    let (_folder, path) = made("gripper");
    let mut collection = Collection::default();
    collection.add(&path).expect("a URDD");
    let page = page_with(&collection.robots()[0]).expect("a page");
    assert!(page.contains(r#"content="inline""#));
    for carried in [
        "robots.json",
        "rules.json",
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

/// What a page carries under a name.
fn carried(page: &str, id: &str) -> Vec<u8> {
    let start = format!(r#"<script type="text/plain" id="{id}">"#);
    let rest = page.split_once(&start).expect(id).1;
    let text = rest.split_once('<').expect("an end").0;
    let packed = STANDARD.decode(text).expect("base64");
    let mut bytes = Vec::new();
    let mut inflated = flate2::read::DeflateDecoder::new(&*packed);
    inflated.read_to_end(&mut bytes).expect("deflated");
    bytes
}

#[test]
fn one_file_holds_what_the_page_reads_and_nothing_of_a_persons() {
    let (_folder, path) = made("welding_arm");
    let secrets = [".env", "dof_module/notes.txt", "mesh_modules/x.html"];
    for name in secrets {
        fs::write(path.join(name), "SECRET").expect("written");
    }
    let mut collection = Collection::default();
    collection.add(&path).expect("a URDD");
    let page = page_with(&collection.robots()[0]).expect("a page");
    let zip = carried(&page, "robot.zip");
    assert!(!String::from_utf8_lossy(&zip).contains("SECRET"));
    let root = Root::of(Archive::new("x", zip).expect("an archive"));
    let files: Vec<String> = root
        .list()
        .expect("a listing")
        .entries
        .into_iter()
        .filter(|entry| entry.kind == EntryKind::File)
        .map(|entry| entry.path)
        .collect();
    assert!(files.iter().any(|path| path.ends_with(".glb")));
    for path in &files {
        assert!(!secrets.contains(&path.as_str()), "{path}");
        assert!(!path.ends_with("module.yaml"), "{path}");
        let is_second =
            (path.ends_with(".stl") || path.ends_with(".obj")) && !path.contains("original");
        assert!(!is_second, "{path}");
    }
    // What is left is enough to place its links and to measure between its hulls and pieces.
    let (part, whole) = (Robot::of(root), Robot::open(&path).expect("a robot"));
    let zero = whole.configurations().expect("it").zero();
    for kind in [ShapeKind::Hulls, ShapeKind::Pieces] {
        let distances = |robot: &Robot| {
            let proximity = robot.proximity(kind).expect("shapes");
            proximity.distances(&zero).expect("distances")
        };
        let (part, whole) = (distances(&part), distances(&whole));
        assert!(!part.is_empty() && part.len() == whole.len());
        // Of another format, so that corners are in another order.
        for (a, b) in part.iter().zip(&whole) {
            assert!((a.distance - b.distance).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
    let report: serde_json::Value =
        serde_json::from_slice(&carried(&page, "report.json")).expect("JSON");
    assert_eq!(report["urdds"][0]["verdict"], "pass");
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
