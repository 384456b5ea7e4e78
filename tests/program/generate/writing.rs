//! What is on disk: always the same bytes, all or nothing, and none of the user's files lost.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use urdd_format::registry::ModuleKind;
use urdd_generate::note::NoteKind;
use urdd_generate::{Generated, Selection, Settings, generate};

use testkit::trials::sample;

use crate::generate::{ascii_stl, bytes_below, findings_of, our_robots, read_json, urdd};

/// A folder with a robot in it: links, a joint and two meshes with the same name.
fn workshop() -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    for (path, text) in [
        ("robot.urdf", ROBOT),
        ("left/part.stl", "left"),
        ("right/part.stl", "right"),
        ("left/Part.STL", "other case"),
    ] {
        let is_mesh = path != "robot.urdf";
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        // Meshes without a surface: the shapes derived from them take no time.
        let text = if is_mesh { ascii_stl(text, "0 0 0") } else { text.to_owned() };
        fs::write(path, text).unwrap();
    }
    let source = folder.path().join("robot.urdf");
    (folder, source)
}

const ROBOT: &str = r#"<robot name="r">
  <link name="a">
    <visual><geometry><mesh filename="left/part.stl"/></geometry></visual>
    <visual><geometry><mesh filename="right/part.stl"/></geometry></visual>
    <collision><geometry><mesh filename="./left/part.stl"/></geometry></collision>
    <collision><geometry><mesh filename="left/Part.STL"/></geometry></collision>
  </link>
  <link name="b"/>
  <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
</robot>
"#;

fn make(source: &Path, target: &Path) -> Generated {
    generate(source, target, &Settings::default(), &()).unwrap()
}

#[test]
fn bytes_are_the_same_for_any_threads_and_folder() {
    for (name, source) in sample(our_robots(), 4) {
        let folder = testkit::temporary::folder();
        let mut seen: Option<BTreeMap<String, Vec<u8>>> = None;
        for (place, threads) in [("one", "1"), ("two/deeper", "2"), ("eight", "8")] {
            // The source gets another folder too: our robots' meshes are beside them.
            let target = folder.path().join(place).join("out");
            let output = urdd(&["generate", "--threads", threads, "-o"])
                .arg(&target)
                .arg(&source)
                .output()
                .unwrap();
            assert!(output.status.success(), "{output:?}");
            let bytes = bytes_below(&target);
            assert!(bytes.len() >= 20, "{name}: {} files", bytes.len());
            assert!(
                seen.get_or_insert_with(|| bytes.clone()) == &bytes,
                "{name}: {threads} threads"
            );
        }
    }
}

#[test]
fn a_robot_moved_with_its_meshes_gives_the_same_bytes() {
    let ((here, one), (there, other)) = (workshop(), workshop());
    make(&one, &here.path().join("out"));
    make(&other, &there.path().join("deep/er/out"));
    let bytes = bytes_below(&here.path().join("out"));
    assert!(bytes == bytes_below(&there.path().join("deep/er/out")));
    let text = String::from_utf8_lossy(&bytes["urdd.json"]).into_owned();
    assert!(!text.contains(here.path().file_name().unwrap().to_str().unwrap()));
}

#[test]
fn each_mesh_is_carried_once_under_a_name_of_its_own() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    make(&source, &target);
    let module = read_json(&target.join("mesh_modules/original_meshes_module/module.json"));
    let paths: Vec<&str> = module["references"]
        .as_array()
        .unwrap()
        .iter()
        .map(|reference| reference["path"].as_str().unwrap())
        .collect();
    let [left, right, again, other_case] = paths[..] else { panic!("{paths:?}") };
    assert_eq!(left, again, "one file, two names");
    let mut lower = [left, right, other_case].map(str::to_lowercase);
    lower.sort();
    assert!(lower.windows(2).all(|pair| pair[0] != pair[1]), "{lower:?}");
    assert_eq!(module["files"].as_array().unwrap().len(), 3);
    let carried =
        [left, right, other_case].map(|path| fs::read_to_string(target.join(path)).unwrap());
    let expected = ["left", "right", "other case"].map(|name| ascii_stl(name, "0 0 0"));
    assert_eq!(carried, expected);
    assert_eq!(findings_of(&target), []);
}

#[test]
fn a_second_run_changes_nothing() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    assert!(make(&source, &target).changed);
    let before = bytes_below(&target);
    let when = fs::metadata(target.join("urdd.json")).unwrap().modified().unwrap();
    assert!(!make(&source, &target).changed);
    assert_eq!(fs::metadata(target.join("urdd.json")).unwrap().modified().unwrap(), when);
    // A damaged file is generated again.
    fs::write(target.join("dof_module/module.json"), "{}").unwrap();
    assert!(make(&source, &target).changed);
    assert!(bytes_below(&target) == before);
    // So is a missing one; and files that do not belong in a module's folder are deleted.
    fs::remove_file(target.join("chain_module/VERSION")).unwrap();
    assert!(make(&source, &target).changed);
    assert!(bytes_below(&target) == before);
}

#[test]
fn modules_are_kept_while_what_they_are_made_of_is_the_same() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    let kept = |made: &Generated| {
        let kept = made.modules.iter().filter(|module| module.kept);
        kept.map(|module| module.kind).collect::<Vec<_>>()
    };
    use ModuleKind::{
        Connections, ConvexDecompositionMeshes, ConvexHullMeshes, LinkShapesApproximations,
        LinkShapesDistanceStatistics, LinkShapesMaxDistanceFromOrigin, LinkShapesSimpleSkips,
        LinkShapesSkips, PlainMeshes,
    };
    let shapes = [
        ConvexHullMeshes,
        ConvexDecompositionMeshes,
        LinkShapesApproximations,
        LinkShapesMaxDistanceFromOrigin,
    ];
    let distances = [LinkShapesDistanceStatistics, LinkShapesSimpleSkips, LinkShapesSkips];
    let all = [&[Connections, PlainMeshes], &shapes[..], &distances].concat();
    assert_eq!(kept(&make(&source, &target)), []);
    assert_eq!(kept(&make(&source, &target)), all);
    // With other effort limits, the chain is the same, and so are the meshes once they are generated again: stages that
    // depend only on these are kept. Distances also depend on the bounds, reasons of skips on the default
    // configuration, and edits of skips on the names of links.
    let limited = "<limit effort=\"1\" velocity=\"1\"/></joint>";
    fs::write(&source, ROBOT.replace("</joint>", limited)).unwrap();
    let made = make(&source, &target);
    let same = [&[Connections], &shapes[..]].concat();
    assert_eq!((kept(&made), made.changed), (same, true));
    // With another name, the chain differs.
    fs::write(&source, ROBOT.replace("\"j\"", "\"k\"")).unwrap();
    assert_eq!(kept(&make(&source, &target)), shapes);
    // A changed file is not kept, nor is one whose inputs are not recorded.
    let file = target.join("connections_module/module.yaml");
    let right = fs::read(&file).unwrap();
    fs::write(&file, "changed").unwrap();
    let rest = &all[1..];
    assert_eq!(kept(&make(&source, &target)), rest);
    assert_eq!(fs::read(&file).unwrap(), right);
    let metadata = fs::read_to_string(target.join("urdd.json")).unwrap();
    fs::write(target.join("urdd.json"), metadata.replace("x_urdd_inputs", "x_other")).unwrap();
    assert_eq!(kept(&make(&source, &target)), []);
    // Kept or not, the bytes are those of a first run.
    make(&source, &target);
    let fresh = folder.path().join("fresh");
    make(&source, &fresh);
    assert!(bytes_below(&target) == bytes_below(&fresh));
}

#[test]
fn files_of_the_users_outlive_a_new_run() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    make(&source, &target);
    fs::write(target.join("README.md"), "mine").unwrap();
    fs::create_dir_all(target.join(".git/refs")).unwrap();
    fs::write(target.join(".git/refs/main"), "0").unwrap();
    let changed = ROBOT.replace("continuous", "fixed");
    fs::write(&source, &changed).unwrap();
    assert!(make(&source, &target).changed);
    assert_eq!(fs::read_to_string(target.join("README.md")).unwrap(), "mine");
    assert_eq!(fs::read_to_string(target.join(".git/refs/main")).unwrap(), "0");
    assert_eq!(findings_of(&target), []);
    // The previously carried source is deleted when another replaces it.
    let other = folder.path().join("other.urdf");
    fs::write(&other, changed).unwrap();
    make(&other, &target);
    assert!(target.join("other.urdf").exists() && !target.join("robot.urdf").exists());
}

#[test]
fn files_of_the_users_in_a_module_that_is_not_made_any_more_are_named() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    let notes = |made: Generated| {
        let kinds = made.notes.into_iter();
        let found = kinds.filter(|note| note.kind == NoteKind::LeftBehind);
        found.map(|note| note.file).collect::<Vec<_>>()
    };
    let core = Settings { selection: Selection::parse(["core"]).unwrap(), ..Settings::default() };
    let hulls = ModuleKind::ConvexHullMeshes.folder();
    let mine = target.join(hulls).join("notes.txt");
    make(&source, &target);
    fs::write(&mine, "mine").unwrap();
    // While the module is made, there is nothing to say.
    assert_eq!(notes(make(&source, &target)), [""; 0]);
    let made = generate(&source, &target, &core, &()).unwrap();
    assert_eq!(notes(made), [target.join(hulls).display().to_string()]);
    assert_eq!(fs::read_to_string(&mine).unwrap(), "mine");
    let codes = findings_of(&target);
    assert!(codes.iter().any(|found| found.0 == "DIR003"), "{codes:?}");
}

#[test]
fn an_extension_module_stays_and_is_listed() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    make(&source, &target);
    let extension = target.join("x_me_colours_module");
    fs::create_dir(&extension).unwrap();
    fs::write(extension.join("VERSION"), "1.0.0\n").unwrap();
    fs::write(extension.join("schema.json"), "{}\n").unwrap();
    fs::write(extension.join("module.json"), "{}\n").unwrap();
    fs::write(extension.join("module.yaml"), "{}\n").unwrap();
    let mut metadata = read_json(&target.join("urdd.json"));
    let files = ["VERSION", "module.json", "module.yaml", "schema.json"].map(|name| {
        serde_json::json!({"path": format!("x_me_colours_module/{name}"), "size": 0, "sha256": "0".repeat(64)})
    });
    metadata["modules"].as_array_mut().unwrap().push(serde_json::json!({
        "name": "x_me_colours_module", "version": "1.0.0", "path": "x_me_colours_module",
        "depends_on": ["urdf_module"], "files": files,
    }));
    fs::write(target.join("urdd.json"), metadata.to_string()).unwrap();
    make(&source, &target);
    assert_eq!(findings_of(&target), []);
    let metadata = read_json(&target.join("urdd.json"));
    let last = metadata["modules"].as_array().unwrap().last().unwrap();
    assert_eq!(last["name"], "x_me_colours_module");
}

#[test]
fn another_folder_is_not_written_to_unless_forced() {
    let (folder, source) = workshop();
    let target = folder.path().join("mine");
    fs::create_dir(&target).unwrap();
    make(&source, &target); // Empty: may be used.
    let target = folder.path().join("thesis");
    fs::create_dir(&target).unwrap();
    fs::write(target.join("chapter.tex"), "text").unwrap();
    let error = generate(&source, &target, &Settings::default(), &()).unwrap_err();
    assert_eq!(error.code(), "not-written");
    assert!(error.to_string().contains("--force"), "{error}");
    assert_eq!(fs::read_dir(&target).unwrap().count(), 1);
    let forced = Settings { force: true, ..Settings::default() };
    generate(&source, &target, &forced, &()).unwrap();
    assert_eq!(fs::read_to_string(target.join("chapter.tex")).unwrap(), "text");
    assert_eq!(findings_of(&target), []);
    // Never over the source itself.
    let error = generate(&source, folder.path(), &forced, &()).unwrap_err();
    assert_eq!(error.code(), "source-in-output");
    // Nor over a file.
    let error = generate(&source, &folder.path().join("left/part.stl"), &forced, &()).unwrap_err();
    assert_eq!(error.code(), "not-written");
}

/// Files larger than this many blocks cannot be written: the system kills the program, or returns an error, as with a
/// full disk.
#[cfg(unix)]
fn with_small_files(source: &Path, target: &Path, before: &str) -> std::process::Output {
    let script = format!("{before} ulimit -f 3; exec \"$@\"");
    Command::new("sh")
        .args(["-c", &script, "sh", env!("CARGO_BIN_EXE_urdd"), "generate"])
        .arg(source)
        .arg("-o")
        .arg(target)
        .output()
        .unwrap()
}

#[cfg(unix)]
#[test]
fn an_ended_or_failed_run_leaves_the_old_or_nothing() {
    let (folder, source) = workshop();
    let target = folder.path().join("out");
    let names = || {
        let names = fs::read_dir(folder.path()).unwrap();
        let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        names.filter(|name| name.contains("out") || name.starts_with('.')).collect::<Vec<_>>()
    };
    // With an error: the program reports it, and cleans up.
    let output = with_small_files(&source, &target, "trap '' XFSZ;");
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("cannot be written: "), "{message}");
    assert_eq!(names(), [""; 0]);
    // Killed: its unfinished output remains, hidden, and so does its lock file.
    let output = with_small_files(&source, &target, "");
    assert_eq!(output.status.code(), None, "{output:?}");
    assert_eq!(names().len(), 2);
    assert!(!target.exists());
    // The next run deletes it.
    make(&source, &target);
    assert_eq!(names(), ["out"]);
    let before = bytes_below(&target);
    fs::write(&source, ROBOT.replace("continuous", "fixed")).unwrap();
    with_small_files(&source, &target, "");
    with_small_files(&source, &target, "trap '' XFSZ;");
    assert!(bytes_below(&target) == before, "the old URDD is as it was");
}

#[test]
fn many_runs_into_one_folder_do_not_mix() {
    let (folder, source) = workshop();
    let other = folder.path().join("other.urdf");
    fs::write(&other, ROBOT.replace("continuous", "fixed")).unwrap();
    let target = folder.path().join("out");
    let runs: Vec<_> = (0..12)
        .map(|i| {
            let source = if i % 2 == 0 { &source } else { &other };
            urdd(&["generate", "-o"])
                .arg(&target)
                .arg(source)
                .stdout(Stdio::null())
                .spawn()
                .unwrap()
        })
        .collect();
    for mut run in runs {
        assert!(run.wait().unwrap().success());
    }
    assert_eq!(findings_of(&target), []);
    let left = fs::read_dir(folder.path()).unwrap();
    let left = left.filter(|entry| {
        let name = entry.as_ref().unwrap().file_name();
        name.to_string_lossy().starts_with('.')
    });
    assert_eq!(left.count(), 0, "left-overs");
}
