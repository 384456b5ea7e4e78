//! The page with one robot in a single file.

use std::fs;
use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use sha2::{Digest, Sha256};
use urdd_directory::listing::EntryKind;
use urdd_directory::root::Root;
use urdd_directory::source::Archive;
use urdd_robot::{Queries, Robot, ShapeKind};
use urdd_view::{Collection, may_hold_page, page_with};

use testkit::robots::made_named;

fn page_of(path: &Path) -> String {
    let collection = Collection::default();
    collection.add(path).expect("a URDD");
    page_with(&collection.robots()[0], None).expect("a page")
}

#[test]
fn one_file_holds_all_and_its_policy_knows_it() {
    let (_folder, path) = made_named("gripper");
    let page = page_of(&path);
    assert!(page.contains(r#"content="inline""#));
    for carried in [
        "robots.json",
        "rules.json",
        "report.json",
        "robot.zip",
        "app.js",
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
    let between = |start: &str, end: &str| {
        let rest = page.split_once(start).expect(start).1;
        rest.split_once(end).expect(end).0.as_bytes().to_vec()
    };
    let code = [
        between("<script>", "</script>"),
        between("<style>", "</style>"),
        carried(&page, "app.js"),
    ];
    assert_eq!(page.matches("'sha256-").count(), code.len());
    for code in code {
        let hash = STANDARD.encode(Sha256::digest(&code));
        assert!(page.contains(&format!("'sha256-{hash}'")));
    }
}

/// In base64 it stays small in a notebook's attribute too, where a quote takes six bytes.
#[test]
fn one_file_is_small() {
    let (_folder, path) = made_named("gripper");
    let page = page_of(&path);
    assert!(page.len() < 2_300_000, "{} bytes", page.len());
    let quotes = page.matches(['"', '\'', '&', '<', '>']).count();
    assert!(quotes < 2_000, "{quotes} characters to escape");
}

/// The content that a page has under a name.
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
    let (_folder, path) = made_named("welding_arm");
    let secrets = [".env", "dof_module/notes.txt", "mesh_modules/x.html"];
    for name in secrets {
        fs::write(path.join(name), "SECRET").expect("written");
    }
    let page = page_of(&path);
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
    // Each original mesh is there, or named as one that the page need not draw: none is missing.
    let entries: Value = serde_json::from_slice(&carried(&page, "robots.json")).expect("JSON");
    let left_out = entries[0]["left_out"].as_array().expect("a list").iter();
    let mut originals: Vec<&str> = left_out.filter_map(Value::as_str).collect();
    assert!(!originals.is_empty());
    assert!(originals.iter().all(|left| !files.iter().any(|path| path == left)));
    originals.extend(files.iter().map(String::as_str));
    let module = "mesh_modules/original_meshes_module/module.json";
    let module = fs::read(path.join(module)).expect("a module");
    let module: Value = serde_json::from_slice(&module).expect("JSON");
    for reference in module["references"].as_array().expect("references") {
        let path = reference["path"].as_str().expect("a path");
        assert!(originals.contains(&path), "{path}");
    }
    // The rest is enough to place its links and to measure between its hulls and pieces.
    let (part, whole) = (Robot::of(root), Robot::open(&path).expect("a robot"));
    let zero = whole.configurations().expect("it").zero();
    for kind in [ShapeKind::Hulls, ShapeKind::Pieces] {
        let distances = |robot: &Robot| {
            let proximity = robot.proximity(kind).expect("shapes");
            proximity.closest_points(&zero).expect("distances")
        };
        let (part, whole) = (distances(&part), distances(&whole));
        assert!(!part.is_empty() && part.len() == whole.len());
        // In another format, so the corners are in another order.
        for (a, b) in part.iter().zip(&whole) {
            assert!((a.distance - b.distance).abs() < 1e-9, "{a:?} {b:?}");
        }
    }
    let report: Value = serde_json::from_slice(&carried(&page, "report.json")).expect("JSON");
    assert_eq!(report["urdds"][0]["verdict"], "pass");
}

/// The JSON and the data of a .glb.
fn glb(bytes: &[u8]) -> (Value, &[u8]) {
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("4 bytes")) as usize;
    let (json, data) = bytes[20..].split_at(length);
    (serde_json::from_slice(json).expect("JSON"), &data[8..])
}

#[test]
fn one_file_rounds_normals_and_nothing_else() {
    let (_folder, path) = made_named("welding_arm");
    let root = Root::of(Archive::new("x", carried(&page_of(&path), "robot.zip")).expect("a zip"));
    let mut rounded = 0;
    for entry in root.list().expect("a listing").entries {
        if entry.kind != EntryKind::File {
            continue;
        }
        let now = root.read(&entry.path, 1 << 30).expect("bytes");
        let before = fs::read(path.join(&entry.path)).expect("bytes");
        let is_plain = entry.path.contains("plain_meshes_module/meshes/glb");
        assert_eq!(now.len(), before.len(), "{}", entry.path);
        assert!(is_plain || now == before, "{}", entry.path);
        if !is_plain {
            continue;
        }
        let ((json, data), (same, old)) = (glb(&now), glb(&before));
        assert_eq!(json, same);
        let primitives = json["meshes"][0]["primitives"].as_array().expect("them");
        let is_normals = |view: usize| {
            let mut all = primitives.iter();
            all.any(|primitive| primitive["attributes"]["NORMAL"] == view)
        };
        for (number, view) in json["bufferViews"].as_array().expect("it").iter().enumerate() {
            let at = |key: &str| usize::try_from(view[key].as_u64().expect(key)).expect(key);
            let range = at("byteOffset")..at("byteOffset") + at("byteLength");
            let (data, old) = (&data[range.clone()], &old[range]);
            if !is_normals(number) {
                assert_eq!(data, old, "{} {number}", entry.path);
                continue;
            }
            for (a, b) in data.chunks_exact(12).zip(old.chunks_exact(12)) {
                let vector = |bytes: &[u8]| {
                    let number = |k| f32::from_le_bytes(bytes[k..k + 4].try_into().expect("4"));
                    nalgebra::Vector3::new(number(0), number(4), number(8))
                };
                let angle = vector(a).angle(&vector(b)).to_degrees();
                assert!(angle < 0.5, "{angle}");
                rounded += usize::from(a != b);
            }
        }
    }
    assert!(rounded > 100, "{rounded} normals");
}

/// A foreign .glb is carried unchanged, whatever its normals.
#[test]
fn one_file_carries_broken_meshes_as_they_are() {
    let (_folder, path) = made_named("welding_arm");
    let folder = "mesh_modules/plain_meshes_module/meshes/glb";
    let entries = fs::read_dir(path.join(folder)).expect("meshes");
    let files = entries.map(|entry| entry.expect("a mesh").path());
    let largest = files.max_by_key(|file| fs::metadata(file).expect("it").len());
    let file = largest.expect("a mesh");
    let name = format!("{folder}/{}", file.file_name().expect("it").display());
    let whole = fs::read(&file).expect("a mesh");
    let (json, data) = glb(&whole);
    let claims = |pointer: &str, value: Value| {
        let mut json = json.clone();
        *json.pointer_mut(pointer).expect(pointer) = value;
        let text = json.to_string();
        let length = u32::try_from(text.len()).expect("short").to_le_bytes();
        let rest = &whole[whole.len() - data.len() - 8..];
        [&whole[..12], &length, b"JSON", text.as_bytes(), rest].concat()
    };
    let put = |bytes: &[u8]| {
        fs::write(&file, bytes).expect("written");
        let zip = carried(&page_of(&path), "robot.zip");
        let root = Root::of(Archive::new("x", zip).expect("a zip"));
        root.read(&name, 1 << 30).expect("it")
    };
    let right = claims("/asset/generator", "urdd".into());
    assert!(put(&right) != right);
    let first = "/meshes/0/primitives/0/attributes/NORMAL";
    for broken in [
        whole[..10].to_vec(),
        whole[..40].to_vec(),
        [&whole[..12], &[0xff; 4], &whole[16..]].concat(),
        claims(first, 999.into()),
        claims(first, Value::Null),
        claims("/bufferViews/1/byteOffset", u64::MAX.into()),
        claims("/bufferViews/1/byteLength", u64::MAX.into()),
        claims("/asset/generator", "others".into()),
    ] {
        assert!(put(&broken) == broken, "{} bytes", broken.len());
    }
}

#[test]
fn a_page_takes_the_place_of_an_unchanged_page_alone() {
    let (_folder, path) = made_named("gripper");
    let page = page_of(&path);
    let folder = testkit::temporary::folder();
    let file = folder.path().join("robot.html");
    assert!(may_hold_page(&file), "nothing is there");
    let mut cut = page.clone();
    cut.truncate(page.trim_end().rfind('\n').expect("a last line") + 1);
    for (text, may) in [
        ("", true),
        ("<!doctype html><title>mine</title>", false),
        ("<head>\n<meta name=\"urdd-mode\" content=\"inline\" />", false),
        (&*page, true),
        (&format!("{page}<p>mine</p>"), false),
        (&page.replacen("<title>urdd</title>", "<title>mine</title>", 1), false),
        (&page.replace('\n', "\r\n"), false),
        (&cut, false),
    ] {
        fs::write(&file, text).expect("written");
        assert_eq!(may_hold_page(&file), may, "{} bytes", text.len());
    }
}
