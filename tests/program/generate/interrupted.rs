//! Runs that are killed, cancelled, or concurrent in one place; and what users put into the folder of a URDD.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use urdd_generate::{Settings, generate};

use crate::generate::{bytes_below, findings_of, urdd};

/// A robot of some links, so that a run takes a while.
fn robot(name: &str, links: usize) -> String {
    let mut text = format!("<robot name=\"{name}\"><link name=\"l0\"/>");
    for i in 1..links {
        let before = i - 1;
        text += &format!(
            "<link name=\"l{i}\"><visual><geometry><box size=\"1 1 {i}\"/></geometry></visual></link>\
             <joint name=\"j{i}\" type=\"continuous\"><parent link=\"l{before}\"/><child link=\"l{i}\"/></joint>"
        );
    }
    text + "</robot>\n"
}

fn workshop(links: usize) -> (tempfile::TempDir, PathBuf) {
    let folder = testkit::temporary::folder();
    let source = folder.path().join("robot.urdf");
    fs::write(&source, robot("r", links)).unwrap();
    (folder, source)
}

fn start(source: &Path, target: &Path) -> Child {
    urdd(&["generate", "--threads", "2", "-o"])
        .args([target, source])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

fn hidden(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap();
    let names = names.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with('.')).collect()
}

/// Waits until a folder contains two hidden entries, the lock and the staging folder: the run has begun.
fn wait_for_work(folder: &Path) {
    let begun = Instant::now();
    while hidden(folder).len() < 2 {
        assert!(begun.elapsed() < Duration::from_secs(60), "it never began");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn send(signal: &str, child: &Child) {
    let status = Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

#[test]
fn a_killed_run_leaves_the_old_and_the_next_one_tidies_up() {
    let (folder, source) = workshop(12);
    let target = folder.path().join("out");
    let make = || generate(&source, &target, &Settings::default(), &()).unwrap();
    make();
    // The existing result, and that of the next run: never the same, so that every run has all of its work to do.
    let mut now = ("r", bytes_below(&target));
    fs::write(&source, robot("other", 12)).unwrap();
    let begun = Instant::now();
    assert!(start(&source, &target).wait().unwrap().success());
    let takes = begun.elapsed();
    let mut next = std::mem::replace(&mut now, ("other", bytes_below(&target)));
    let mut killed = 0;
    for i in 0..30 {
        fs::write(&source, robot(next.0, 12)).unwrap();
        let mut child = start(&source, &target);
        std::thread::sleep(takes * i / 30);
        let _ = child.kill();
        killed += usize::from(child.wait().unwrap().signal() == Some(9));
        let found = bytes_below(&target);
        assert!(found == now.1 || found == next.1, "kill {i}");
        if found == next.1 {
            std::mem::swap(&mut now, &mut next);
        }
        // Nobody mistakes what is left for a URDD.
        let found = urdd_directory::discover::discover(folder.path()).unwrap();
        let found: Vec<&str> = found.iter().map(|urdd| urdd.name.as_str()).collect();
        assert_eq!(found, ["out"]);
    }
    assert!(killed > 10, "{killed} of 30 runs were killed");
    fs::write(&source, robot(next.0, 12)).unwrap();
    make();
    assert!(bytes_below(&target) == next.1);
    assert_eq!(hidden(folder.path()), [""; 0]);
}

#[test]
fn what_is_read_only_in_a_left_over_goes_too() {
    // A robot of two links is made while the test sleeps.
    let (folder, source) = workshop(12);
    let target = folder.path().join("out");
    let mut child = start(&source, &target);
    wait_for_work(folder.path());
    child.kill().unwrap();
    child.wait().unwrap();
    for name in hidden(folder.path()) {
        let path = folder.path().join(name);
        if path.is_dir() {
            let inner = path.join("new/inner");
            fs::create_dir_all(&inner).unwrap();
            fs::write(inner.join("file"), "x").unwrap();
            fs::set_permissions(&inner, Permissions::from_mode(0o555)).unwrap();
        }
    }
    generate(&source, &target, &Settings::default(), &()).unwrap();
    assert_eq!(hidden(folder.path()), [""; 0]);
}

/// Ctrl-C and `kill` end a batch between two modules, and nothing is left behind.
#[test]
fn a_batch_that_is_asked_to_stop_leaves_whole_urdds_and_nothing_else() {
    for (signal, status) in [("-INT", 130), ("-TERM", 143)] {
        let folder = testkit::temporary::folder();
        let robots = folder.path().join("robots");
        let out = folder.path().join("out");
        fs::create_dir_all(&robots).unwrap();
        fs::create_dir_all(&out).unwrap();
        for i in 0..40 {
            fs::write(robots.join(format!("r{i}.urdf")), robot("r", 10)).unwrap();
        }
        let child = urdd(&["generate", "-o"])
            .args([&out, &robots])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        wait_for_work(&out);
        send(signal, &child);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{output:?}");
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(words.contains("stopped by a signal"), "{words}");
        assert_eq!(hidden(&out), [""; 0]);
        let made: Vec<_> = fs::read_dir(&out).unwrap().flatten().collect();
        assert!(made.len() < 40, "the batch was done before it was stopped");
        for entry in made {
            assert_eq!(findings_of(&entry.path()), []);
        }
    }
}

/// Two robots, many runs: the result is one of the two, byte for byte.
#[test]
fn runs_at_once_into_one_place_wait_for_each_other() {
    let (folder, source) = workshop(3);
    let other = folder.path().join("other.urdf");
    fs::write(&other, robot("other", 4)).unwrap();
    let wanted: Vec<BTreeMap<String, Vec<u8>>> = [&source, &other]
        .map(|source| {
            let place = folder.path().join("wanted").join(source.file_stem().unwrap());
            generate(source, &place, &Settings::default(), &()).unwrap();
            bytes_below(&place)
        })
        .into();
    let target = folder.path().join("out");
    let runs: Vec<Child> =
        (0..24).map(|i| start(if i % 2 == 0 { &source } else { &other }, &target)).collect();
    for mut run in runs {
        assert!(run.wait().unwrap().success());
    }
    assert!(wanted.contains(&bytes_below(&target)));
    assert_eq!(hidden(folder.path()), [""; 0]);
}

#[test]
fn files_of_a_person_in_the_folders_of_modules_stay() {
    let (folder, source) = workshop(2);
    let target = folder.path().join("mine");
    let mine = ["mesh_modules/mystuff/a", "urdf_module/mine.txt", "notes/b.txt"];
    for path in mine {
        let path = target.join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, "mine").unwrap();
    }
    fs::set_permissions(target.join("notes"), Permissions::from_mode(0o700)).unwrap();
    fs::set_permissions(target.join("urdf_module"), Permissions::from_mode(0o700)).unwrap();
    fs::set_permissions(&target, Permissions::from_mode(0o700)).unwrap();
    let mode = |path: &str| {
        let metadata = fs::metadata(target.join(path)).unwrap();
        metadata.permissions().mode() & 0o777
    };
    let forced = Settings { force: true, ..Settings::default() };
    for run in 0..2 {
        generate(&source, &target, &forced, &()).unwrap();
        for path in mine {
            let text = fs::read_to_string(target.join(path)).unwrap_or_default();
            assert_eq!(text, "mine", "run {run}: {path}");
        }
        for path in ["", "notes", "urdf_module"] {
            assert_eq!(mode(path), 0o700, "run {run}: {path:?}");
        }
    }
    // Results of the previous run that this run does not produce are deleted.
    assert!(target.join("dof_module/module.json").exists());
    assert!(target.join("mesh_modules/plain_meshes_module").exists());
    let core = Settings {
        selection: urdd_generate::Selection::parse(["core"]).unwrap(),
        ..Settings::default()
    };
    generate(&source, &target, &core, &()).unwrap();
    assert!(!target.join("mesh_modules/plain_meshes_module").exists());
    assert!(target.join("mesh_modules/mystuff/a").exists());
}

#[test]
fn a_file_of_a_person_in_the_place_of_the_urdf_is_not_overwritten() {
    let (folder, source) = workshop(2);
    let target = folder.path().join("mine");
    fs::create_dir(&target).unwrap();
    fs::write(target.join("robot.urdf"), "<robot name='mine'/>").unwrap();
    let forced = Settings { force: true, ..Settings::default() };
    let error = generate(&source, &target, &forced, &()).unwrap_err();
    assert!(error.to_string().contains("move it away"), "{error}");
    assert_eq!(bytes_below(&target).len(), 1);
    // The very same file is no trouble.
    fs::copy(&source, target.join("robot.urdf")).unwrap();
    generate(&source, &target, &forced, &()).unwrap();
    assert_eq!(findings_of(&target), []);
}

#[test]
fn a_name_as_long_as_the_file_system_allows_is_written() {
    let (folder, source) = workshop(2);
    for length in [250, 255] {
        let target = folder.path().join("n".repeat(length));
        generate(&source, &target, &Settings::default(), &()).unwrap();
        assert_eq!(findings_of(&target), []);
    }
    assert_eq!(hidden(folder.path()), [""; 0]);
}

#[test]
fn rehash_that_fails_leaves_nothing_and_keeps_the_mode() {
    let (folder, source) = workshop(2);
    let target = folder.path().join("out");
    generate(&source, &target, &Settings::default(), &()).unwrap();
    let metadata = target.join("urdd.json");
    fs::set_permissions(&metadata, Permissions::from_mode(0o640)).unwrap();
    let version = target.join("dof_module/VERSION");
    fs::write(&version, "1.0.0").unwrap();
    let rehash = |before: &str| {
        let script = format!("{before} exec \"$@\"");
        Command::new("sh")
            .args(["-c", &script, "sh", env!("CARGO_BIN_EXE_urdd"), "rehash"])
            .arg(&target)
            .output()
            .unwrap()
    };
    let output = rehash("trap '' XFSZ; ulimit -f 1;");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(hidden(&target), [".gitattributes"]);
    let output = rehash("");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    assert_eq!(hidden(&target), [".gitattributes"]);
    let mode = fs::metadata(&metadata).unwrap().permissions().mode() & 0o777;
    assert_eq!(mode, 0o640);
    assert_eq!(findings_of(&target), []);
}
