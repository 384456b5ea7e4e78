//! Robots that are generated while the page is open, and follow their files.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use serde_json::Value;
use urdd_directory::cancellation::Cancellation;
use urdd_generate::batch::Observer;
use urdd_generate::{GenerateError, Generated, Progress, Settings};
use urdd_source::robots::Job;
use urdd_view::{Collection, Live, Source};

use super::asking::Running;
use testkit::requests::is_whole;
use testkit::urdfs::arm;

/// A tetrahedron.
const MESH: &str = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

pub struct Quiet;

impl Observer for Quiet {
    fn begin(&self, _: &Job) -> Box<dyn Progress> {
        Box::new(())
    }
    fn done(&self, _: &Job, _: &Result<Generated, GenerateError>) {}
}

/// Ends a run when a test ends, or fails.
pub struct Ends(pub Cancellation);

impl Drop for Ends {
    fn drop(&mut self) {
        self.0.cancel();
    }
}

/// Acts on a server while its robots are generated and followed.
pub fn living(collection: Collection, act: impl FnOnce(&Running)) {
    living_after(Duration::from_millis(50), collection, act);
}

/// As [`living`], with a pause between the picture of a robot and the rest of it.
fn living_after(pause: Duration, collection: Collection, act: impl FnOnce(&Running)) {
    let folder = testkit::temporary::folder();
    let settings = Settings::default();
    let collection = Arc::new(collection);
    let live = Live { folder: folder.path(), settings: &settings, observer: &Quiet, pause };
    std::thread::scope(|scope| {
        scope.spawn(|| live.run(&collection));
        let _ends = Ends(settings.source.cancellation.clone());
        act(&Running::with(Arc::clone(&collection)));
    });
}

pub fn of(urdfs: &[&Path]) -> Collection {
    let collection = Collection::default();
    for urdf in urdfs {
        let source =
            Source { file: urdf.to_path_buf(), packages: Vec::new(), arguments: Vec::new() };
        let name = urdf.file_stem().unwrap_or_default().to_string_lossy();
        collection.add_source(name.into_owned(), source);
    }
    collection
}

fn is_broken(answer: &Value) -> bool {
    !answer["entry"]["failure"].is_null()
}

fn upper(server: &Running) -> f64 {
    let bounds = server.json("/robots/arm/files/urdf_module/module.json");
    bounds["joints"][0]["limit"]["upper"].as_f64().expect("a limit")
}

fn has(server: &Running, module: &str) -> bool {
    let files = server.json("/robots/arm/files.json");
    let mut files = files["files"].as_array().expect("a list").iter();
    files.any(|file| file["path"].as_str().is_some_and(|path| path.contains(module)))
}

#[test]
fn the_picture_comes_first_and_a_change_is_shown() {
    let around = testkit::temporary::folder();
    let folder = around.path().join("a robot");
    fs::create_dir(&folder).expect("a folder");
    let urdf = folder.join("arm.urdf");
    let sphere = r#"<sphere radius="0.3"/>"#;
    fs::write(&urdf, arm(1.0, sphere)).expect("written");
    // Longer than any answer takes.
    living_after(Duration::from_secs(3), of(&[&urdf]), |server| {
        let first = server.until("arm", |answer| answer["entry"]["ready"] == true);
        assert_eq!(upper(server), 1.0);
        assert!(has(server, "plain_meshes_module"));
        assert!(!has(server, "convex_decomposition_meshes_module"));
        let whole = server.until("arm", is_whole);
        assert_ne!(first["revision"], whole["revision"]);
    });
    living(of(&[&urdf]), |server| {
        let whole = server.until("arm", is_whole);
        let _ = server.json("/robots/arm/files.json");
        assert!(has(server, "convex_decomposition_meshes_module"));

        fs::write(&urdf, arm(2.0, sphere)).expect("written");
        let changed = |answer: &Value| answer["revision"] != whole["revision"];
        server.until("arm", |answer| changed(answer) && is_whole(answer));
        assert!(has(server, "link_shapes_skips_module"));
        assert_eq!(upper(server), 2.0);

        // What breaks the URDF is said, and the last robot stays.
        let whole = server.until("arm", is_whole);
        fs::write(&urdf, "<robot name=").expect("written");
        let broken = server.until("arm", is_broken);
        let why = broken["entry"]["failure"].as_str().expect("a reason");
        assert!(why.contains("arm.urdf"), "{why}");
        assert_eq!(broken["revision"], whole["revision"]);
        assert_eq!(broken["entry"]["ready"], true);

        // Editors write another file, and put it in the place of the first.
        fs::remove_file(&urdf).expect("removed");
        let gone = |answer: &Value| answer["entry"]["failure"] != why && is_broken(answer);
        server.until("arm", gone);
        let beside = folder.join("arm.urdf.new");
        fs::write(&beside, arm(3.0, sphere)).expect("written");
        fs::rename(&beside, &urdf).expect("renamed");
        server.until("arm", is_whole);
        let _ = server.json("/robots/arm/files.json");
        assert_eq!(upper(server), 3.0);

        // The folder goes, and comes back.
        let away = around.path().join("away");
        fs::rename(&folder, &away).expect("renamed");
        let gone = server.until("arm", is_broken);
        assert_eq!(gone["entry"]["ready"], true);
        fs::rename(&away, &folder).expect("renamed");
        server.until("arm", is_whole);
    });
}

#[test]
fn the_report_is_that_of_lint_with_the_text_and_the_rules() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    let text = arm(1.0, r#"<sphere radius="0.3"/>"#);
    let text = text.replace(" velocity=\"1\"", "");
    fs::write(&urdf, &text).expect("written");
    living(of(&[&urdf]), |server| {
        server.until("arm", |answer| answer["entry"]["ready"] == true);
        let report = || server.json("/robots/arm/report.json");
        let first = report();
        assert_eq!(first["text"], text);
        let found = &first["urdds"][0];
        assert_eq!((&found["kind"], &found["path"]), (&"urdf".into(), &"arm.urdf".into()));
        let has = |report: &Value, code: &str, of: &str| {
            let all = match of {
                "rules" => &report["rules"],
                _ => &report["urdds"][0]["findings"],
            };
            let mut all = all.as_array().expect("a list").iter();
            all.any(|one| one["code"] == code)
        };
        assert!(has(&first, "LNT017", "findings") && has(&first, "LNT017", "rules"), "{first}");

        // It is that of the file as it is now, also where no robot can be made of it.
        fs::write(&urdf, &text[..text.len() - 9]).expect("written");
        let broken = report();
        assert!(has(&broken, "URD011", "findings"), "{broken}");
        fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        assert!(!has(&report(), "LNT017", "findings"));

        // The nearest urdd.toml counts, as for an editor; one that is broken is said.
        let settings = folder.path().join("urdd.toml");
        let ignore = "[[ignore]]\ncode = \"LNT017\"\npath = \"arm.urdf\"\nreason = \"known\"\n";
        fs::write(&urdf, &text).expect("written");
        fs::write(&settings, ignore).expect("written");
        let without = report();
        assert!(!has(&without, "LNT017", "findings"), "{without}");
        let read = without["settings"]["file"].as_str().expect("a path");
        assert_eq!(Path::new(read), settings);
        assert_eq!(without["settings"]["fault"], Value::Null);
        fs::write(&settings, "[[ignore").expect("written");
        let with = report();
        assert!(has(&with, "LNT017", "findings"), "{with}");
        let fault = with["settings"]["fault"].as_str().expect("a fault");
        assert!(fault.contains("urdd.toml:1"), "{fault}");
        fs::remove_file(&settings).expect("removed");
        assert_eq!(report()["settings"]["file"], Value::Null);
        fs::write(&urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");

        // A robot that is saved is a URDD.
        server.until("arm", is_whole);
        let wish = serde_json::json!({ "folder": folder.path().join("saved").to_str() });
        assert_eq!(server.post("/robots/arm/keep", &wish).status, 200);
        let saved = report();
        assert_eq!(saved["urdds"][0]["kind"], "urdd");
        assert!(saved["text"].is_null());
    });
}

/// By them, a baseline tells robots of one file apart.
#[test]
fn the_report_has_the_arguments_that_are_declared() {
    let folder = testkit::temporary::folder();
    let file = folder.path().join("arm.urdf");
    fs::write(&file, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    let collection = Collection::default();
    let arguments = vec!["type:=long".to_owned()];
    collection.add_source("arm".to_owned(), Source { file, packages: Vec::new(), arguments });
    living(collection, |server| {
        server.until("arm", |answer| answer["entry"]["ready"] == true);
        let report = server.json("/robots/arm/report.json");
        let found = &report["urdds"][0]["xacro_arguments"];
        assert_eq!(found, &serde_json::json!(["type:=long"]));
    });
}

#[test]
fn meshes_are_followed_and_those_that_are_missing_too() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    let mesh = folder.path().join("b.obj");
    fs::write(&urdf, arm(1.0, r#"<mesh filename="b.obj"/>"#)).expect("written");
    let path = "/robots/arm/files/mesh_modules/original_meshes_module/module.json";
    living(of(&[&urdf]), |server| {
        let stored = || {
            let _ = server.json("/robots/arm/files.json");
            server.json(path)["references"][0]["path"].clone()
        };
        let without = server.until("arm", is_whole);
        let notes = without["entry"]["notes"].to_string();
        assert!(notes.contains("b.obj` was not found"), "{notes}");
        assert!(stored().is_null());
        fs::write(&mesh, MESH).expect("written");
        let changed = |before: &Value, answer: &Value| {
            answer["revision"] != before["revision"] && is_whole(answer)
        };
        let with = server.until("arm", |answer| changed(&without, answer));
        assert!(stored().is_string());
        fs::write(&mesh, MESH.replace(".1", ".2")).expect("written");
        let other = server.until("arm", |answer| changed(&with, answer));
        fs::remove_file(&mesh).expect("removed");
        // One write can be seen as two changes, so the note tells, not the revision.
        server.until("arm", |answer| {
            let notes = answer["entry"]["notes"].to_string();
            changed(&other, answer) && notes.contains("b.obj` was not found")
        });
        assert!(stored().is_null());
    });
}

#[test]
fn robots_of_a_gallery_are_generated_when_they_are_opened() {
    let folder = testkit::temporary::folder();
    let urdfs = ["one", "two"].map(|name| folder.path().join(format!("{name}.urdf")));
    for urdf in &urdfs {
        fs::write(urdf, arm(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    }
    living(of(&[&urdfs[0], &urdfs[1]]), |server| {
        server.until("one", is_whole);
        let robots = server.json("/robots.json");
        let two = &robots[1];
        assert_eq!(two["id"], "two");
        assert!(two["ready"] == false && two["making"].is_null() && two["failure"].is_null());
        server.until("two", is_whole);
        // One that is saved is the user's: the URDF is not followed any more.
        let target = folder.path().join("saved");
        let wish = serde_json::json!({ "folder": target.to_str() });
        let answer = server.post("/robots/two/keep", &wish);
        assert_eq!(answer.status, 200, "{}", answer.text());
        let saved = server.until("two", is_whole);
        fs::write(&urdfs[1], arm(2.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        fs::write(&urdfs[0], arm(2.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        let one = server.until("one", is_whole);
        server.until("one", |answer| {
            let _ = server.json("/robots/two/revision.json");
            answer["revision"] != one["revision"]
        });
        let now = server.until("two", is_whole);
        assert_eq!(now["revision"], saved["revision"]);
    });
}
