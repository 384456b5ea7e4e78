//! Robots that are generated while the page is open, and follow their files.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::Value;
use urdd_directory::cancellation::Cancellation;
use urdd_generate::batch::Observer;
use urdd_generate::{GenerateError, Generated, Progress, Settings};
use urdd_source::robots::Job;
use urdd_view::{Collection, Live, Source};

use super::asking::Running;

/// Longest wait for something that has to come.
const PATIENCE: Duration = Duration::from_secs(120);

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
struct Ends(Cancellation);

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
        let _ends = Ends(settings.cancellation.clone());
        act(&Running::with(Arc::clone(&collection)));
    });
}

fn of(urdfs: &[&Path]) -> Collection {
    let collection = Collection::default();
    for urdf in urdfs {
        let source = Source { file: urdf.to_path_buf(), packages: Vec::new() };
        let name = urdf.file_stem().unwrap_or_default().to_string_lossy();
        collection.add_source(name.into_owned(), source);
    }
    collection
}

/// The first answer about a robot that is as wanted. Asks as the page does that shows it.
pub fn until(server: &Running, id: &str, wanted: impl Fn(&Value) -> bool) -> Value {
    let begun = Instant::now();
    loop {
        let answer = server.json(&format!("/robots/{id}/revision.json"));
        if wanted(&answer) {
            return answer;
        }
        assert!(begun.elapsed() < PATIENCE, "it stays {answer}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

pub fn is_whole(answer: &Value) -> bool {
    answer["entry"]["ready"] == true && answer["entry"]["making"].is_null() && !is_broken(answer)
}

fn is_broken(answer: &Value) -> bool {
    !answer["entry"]["failure"].is_null()
}

fn robot(upper: f64, geometry: &str) -> String {
    format!(
        r#"<robot name="arm"><link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
        <link name="b"><visual><origin xyz="0 0 2"/><geometry>{geometry}</geometry></visual></link>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="{upper}" effort="1" velocity="1"/></joint></robot>"#
    )
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
    fs::write(&urdf, robot(1.0, sphere)).expect("written");
    // Longer than any answer takes.
    living_after(Duration::from_secs(3), of(&[&urdf]), |server| {
        let first = until(server, "arm", |answer| answer["entry"]["ready"] == true);
        assert_eq!(upper(server), 1.0);
        assert!(has(server, "plain_meshes_module"));
        assert!(!has(server, "convex_decomposition_meshes_module"));
        let whole = until(server, "arm", is_whole);
        assert_ne!(first["revision"], whole["revision"]);
    });
    living(of(&[&urdf]), |server| {
        let whole = until(server, "arm", is_whole);
        let _ = server.json("/robots/arm/files.json");
        assert!(has(server, "convex_decomposition_meshes_module"));

        fs::write(&urdf, robot(2.0, sphere)).expect("written");
        let changed = |answer: &Value| answer["revision"] != whole["revision"];
        until(server, "arm", |answer| changed(answer) && is_whole(answer));
        assert!(has(server, "link_shapes_skips_module"));
        assert_eq!(upper(server), 2.0);

        // What breaks the URDF is said, and the last robot stays.
        let whole = until(server, "arm", is_whole);
        fs::write(&urdf, "<robot name=").expect("written");
        let broken = until(server, "arm", is_broken);
        let why = broken["entry"]["failure"].as_str().expect("a reason");
        assert!(why.contains("arm.urdf"), "{why}");
        assert_eq!(broken["revision"], whole["revision"]);
        assert_eq!(broken["entry"]["ready"], true);

        // Editors write another file, and put it in the place of the first.
        fs::remove_file(&urdf).expect("removed");
        let gone = |answer: &Value| answer["entry"]["failure"] != why && is_broken(answer);
        until(server, "arm", gone);
        let beside = folder.join("arm.urdf.new");
        fs::write(&beside, robot(3.0, sphere)).expect("written");
        fs::rename(&beside, &urdf).expect("renamed");
        until(server, "arm", is_whole);
        let _ = server.json("/robots/arm/files.json");
        assert_eq!(upper(server), 3.0);

        // The folder goes, and comes back.
        let away = around.path().join("away");
        fs::rename(&folder, &away).expect("renamed");
        let gone = until(server, "arm", is_broken);
        assert_eq!(gone["entry"]["ready"], true);
        fs::rename(&away, &folder).expect("renamed");
        until(server, "arm", is_whole);
    });
}

#[test]
fn the_report_is_that_of_lint_with_the_text_and_the_rules() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    let text = robot(1.0, r#"<sphere radius="0.3"/>"#);
    let text = text.replace(" velocity=\"1\"", "");
    fs::write(&urdf, &text).expect("written");
    living(of(&[&urdf]), |server| {
        until(server, "arm", |answer| answer["entry"]["ready"] == true);
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
        fs::write(&urdf, robot(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
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
        fs::write(&urdf, robot(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");

        // A robot that is saved is a URDD.
        until(server, "arm", is_whole);
        let wish = serde_json::json!({ "folder": folder.path().join("saved").to_str() });
        assert_eq!(server.post("/robots/arm/keep", &wish).status, 200);
        let saved = report();
        assert_eq!(saved["urdds"][0]["kind"], "urdd");
        assert!(saved["text"].is_null());
    });
}

#[test]
fn meshes_are_followed_and_those_that_are_missing_too() {
    let folder = testkit::temporary::folder();
    let urdf = folder.path().join("arm.urdf");
    let mesh = folder.path().join("b.obj");
    fs::write(&urdf, robot(1.0, r#"<mesh filename="b.obj"/>"#)).expect("written");
    let path = "/robots/arm/files/mesh_modules/original_meshes_module/module.json";
    living(of(&[&urdf]), |server| {
        let stored = || {
            let _ = server.json("/robots/arm/files.json");
            server.json(path)["references"][0]["path"].clone()
        };
        let without = until(server, "arm", is_whole);
        let notes = without["entry"]["notes"].to_string();
        assert!(notes.contains("b.obj` was not found"), "{notes}");
        assert!(stored().is_null());
        fs::write(&mesh, MESH).expect("written");
        let changed = |before: &Value, answer: &Value| {
            answer["revision"] != before["revision"] && is_whole(answer)
        };
        let with = until(server, "arm", |answer| changed(&without, answer));
        assert!(stored().is_string());
        fs::write(&mesh, MESH.replace(".1", ".2")).expect("written");
        let other = until(server, "arm", |answer| changed(&with, answer));
        fs::remove_file(&mesh).expect("removed");
        // One write can be seen as two changes, so the note tells, not the revision.
        until(server, "arm", |answer| {
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
        fs::write(urdf, robot(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    }
    living(of(&[&urdfs[0], &urdfs[1]]), |server| {
        until(server, "one", is_whole);
        let robots = server.json("/robots.json");
        let two = &robots[1];
        assert_eq!(two["id"], "two");
        assert!(two["ready"] == false && two["making"].is_null() && two["failure"].is_null());
        until(server, "two", is_whole);
        // One that is saved is the user's: the URDF is not followed any more.
        let target = folder.path().join("saved");
        let wish = serde_json::json!({ "folder": target.to_str() });
        let answer = server.post("/robots/two/keep", &wish);
        assert_eq!(answer.status, 200, "{}", answer.text());
        let saved = until(server, "two", is_whole);
        fs::write(&urdfs[1], robot(2.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        fs::write(&urdfs[0], robot(2.0, r#"<sphere radius="0.3"/>"#)).expect("written");
        let one = until(server, "one", is_whole);
        until(server, "one", |answer| {
            let _ = server.json("/robots/two/revision.json");
            answer["revision"] != one["revision"]
        });
        let now = until(server, "two", is_whole);
        assert_eq!(now["revision"], saved["revision"]);
    });
}

fn view(words: &[&Path]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
    command.arg("view").args(words);
    command
}

#[test]
fn a_package_shows_its_urdfs_and_runs_xacro_only_if_it_may() {
    let folder = testkit::temporary::folder();
    let package = folder.path().join("arms");
    fs::create_dir_all(package.join("urdf")).expect("a folder");
    fs::write(package.join("package.xml"), "<package><name>arms</name></package>").expect("it");
    let text = robot(1.0, r#"<sphere radius="0.3"/>"#);
    for name in ["one.urdf", "two.urdf", "three.urdf.xacro"] {
        fs::write(package.join("urdf").join(name), &text).expect("written");
    }
    let site = folder.path().join("site");
    let done = view(&[&package]).arg("--export").arg(&site).output().expect("it runs");
    let (said, errors) =
        (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{errors}");
    assert!(said.contains("a site of 2 robots"), "{said}");
    assert!(errors.contains("left out 1 .urdf.xacro file; --xacro runs them"), "{errors}");
    fs::remove_file(package.join("urdf/one.urdf")).expect("removed");
    fs::remove_file(package.join("urdf/two.urdf")).expect("removed");
    let done = view(&[&package]).arg("--no-open").output().expect("it runs");
    assert_eq!(done.status.code(), Some(2));
}

#[cfg(unix)]
#[test]
fn what_xacro_includes_is_followed() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("bin")).expect("a folder");
    // Not beside the robot: in a package that the command line names.
    fs::create_dir(at("parts")).expect("a folder");
    let elsewhere = testkit::temporary::folder();
    let arm = elsewhere.path().join("arm.xacro");
    let part = at("parts/part.xacro");
    // As the program of that name does: the expanded file, or the list of what it includes.
    let script = "#!/bin/sh\npart=${ROS_PACKAGE_PATH%%:*}/parts/part.xacro\n\
        if [ \"$1\" = --deps ]; then echo \"$part\"; else cat \"$part\"; fi\n";
    fs::write(at("bin/xacro"), script).expect("written");
    fs::set_permissions(at("bin/xacro"), fs::Permissions::from_mode(0o755)).expect("set");
    fs::write(&arm, "<robot/>").expect("written");
    let sphere = r#"<sphere radius="0.3"/>"#;
    fs::write(&part, robot(1.0, sphere)).expect("written");
    let package = format!("parts={}", at("parts").display());
    let mut child = view(&[&arm, &PathBuf::from("--no-open")])
        .args(["--package", &package])
        .env("PATH", format!("{}:/usr/bin:/bin", at("bin").display()))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it runs");
    let mut line = String::new();
    let output = child.stdout.take().expect("a pipe");
    BufReader::new(output).read_line(&mut line).expect("a line");
    let address = line.trim().rsplit(' ').next().expect("an address");
    let server = Running::at(address);
    let _ends = Interrupts(child);
    let first = until(&server, "arm", is_whole);
    fs::write(&part, robot(2.0, sphere)).expect("written");
    let changed = |answer: &Value| answer["revision"] != first["revision"];
    until(&server, "arm", |answer| changed(answer) && is_whole(answer));
    let _ = server.json("/robots/arm/files.json");
    assert_eq!(upper(&server), 2.0);
}

/// Everybody on the machine can read the arguments of a program: a browser gets the path of a file that leads on.
#[cfg(target_os = "linux")]
#[test]
fn the_token_is_in_no_argument() {
    use std::os::unix::fs::PermissionsExt;
    let folder = testkit::temporary::folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("bin")).expect("a folder");
    let script = "#!/bin/sh\necho \"$@\" > \"$SEEN.part\"; tr '\\0' '\\n' < /proc/$$/environ >> \"$SEEN.part\"\n\
        mv \"$SEEN.part\" \"$SEEN\"\n";
    fs::write(at("bin/xdg-open"), script).expect("written");
    fs::set_permissions(at("bin/xdg-open"), fs::Permissions::from_mode(0o755)).expect("set");
    let urdf = at("arm.urdf");
    fs::write(&urdf, robot(1.0, r#"<sphere radius="0.3"/>"#)).expect("written");
    let mut child = view(&[&urdf])
        .env("PATH", format!("{}:/usr/bin:/bin", at("bin").display()))
        .env("SEEN", at("seen"))
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("it runs");
    let mut line = String::new();
    let output = child.stdout.take().expect("a pipe");
    BufReader::new(output).read_line(&mut line).expect("a line");
    let address = line.trim().rsplit(' ').next().expect("an address");
    let token = Running::at(address).token.clone();
    let ends = Interrupts(child);
    let begun = Instant::now();
    while !at("seen").exists() {
        assert!(begun.elapsed() < PATIENCE, "no browser was opened");
        std::thread::sleep(Duration::from_millis(20));
    }
    let seen = fs::read_to_string(at("seen")).expect("a file");
    assert!(!seen.contains(&token), "{seen}");
    let page = PathBuf::from(seen.lines().next().expect("an argument"));
    let mode = |path: &Path| fs::metadata(path).expect("it").permissions().mode() & 0o777;
    assert_eq!(mode(&page), 0o600);
    assert_eq!(mode(page.parent().expect("a folder")), 0o700);
    let text = fs::read_to_string(&page).expect("a page");
    assert!(text.contains(&format!("content=\"0; url={address}\"")), "{text}");
    drop(ends);
    assert!(!page.exists());
}

/// Ends a program as Ctrl-C does, so that it removes its temporary folder.
#[cfg(unix)]
struct Interrupts(std::process::Child);

#[cfg(unix)]
impl Drop for Interrupts {
    fn drop(&mut self) {
        let id = self.0.id().to_string();
        let _ = Command::new("kill").args(["-INT", &id]).status();
        let _ = self.0.wait();
    }
}
