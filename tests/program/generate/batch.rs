//! Many robots in one run.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use serde_json::Value;
use urdd_format::registry::ModuleKind;
use urdd_generate::batch::{Observer, Shard};
use urdd_generate::{GenerateError, Generated, Progress, Settings};
use urdd_source::robots::{Job, jobs};

use crate::generate::{findings_of, urdd};

const GOOD: &str = "<robot name=\"r\"><link name=\"a\"/></robot>\n";

/// Folders with good robots, bad ones, and files with equal names.
fn folder() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    for (path, text) in [
        ("arm/arm.urdf", GOOD),
        ("leg/robot.urdf", GOOD),
        ("hand/robot.urdf", GOOD),
        ("hand/Robot.urdf", GOOD),
        ("hand/left/deep/robot.urdf", GOOD),
        ("bad/broken.urdf", "<robot name=\"r\"><link"),
        ("bad/loose.urdf", "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/></robot>"),
        ("arm/arm.urdf.xacro", "not looked at"),
        ("made/urdd.json", "{}"),
        ("made/robot.urdf", "not looked at"),
        (".hidden/robot.urdf", "not looked at"),
        ("readme.txt", "not looked at"),
    ] {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn run(folder: &Path, more: &[&str]) -> (Option<i32>, Vec<Value>) {
    let output = urdd(&["generate", "--format", "json", "-o"])
        .arg(folder.join("out"))
        .arg(folder)
        .args(more)
        .output()
        .unwrap();
    assert!(output.stderr.is_empty(), "{output:?}");
    let text = String::from_utf8(output.stdout).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str(line).unwrap());
    (output.status.code(), lines.collect())
}

#[test]
fn a_bad_robot_stops_nothing() {
    let folder = folder();
    let (status, lines) = run(folder.path(), &["--threads", "2"]);
    assert_eq!(status, Some(1));
    let of = |status: &str| lines.iter().filter(|line| line["status"] == status).count();
    assert_eq!((of("generated"), of("failed"), lines.len()), (5, 2, 8));
    let summary = &lines[7]["summary"];
    assert_eq!(summary["generated"], 5);
    assert_eq!(summary["failed"], 2);
    let loose = lines.iter().find(|line| line["output"] == "loose").unwrap();
    assert_eq!(loose["error"]["code"], "refused");
    assert_eq!(loose["error"]["faults"][0]["line"], 1);
    assert!(!folder.path().join("out/loose").exists());
    assert_eq!(findings_of(&folder.path().join("out/arm")), []);
    // Again: the same lines, except for unchanged robots; the output folder is not searched.
    let (_, again) = run(folder.path(), &["--threads", "1"]);
    assert_eq!(again[7]["summary"]["unchanged"], 5);
    let outputs =
        |lines: &[Value]| lines.iter().map(|line| line["output"].clone()).collect::<Vec<_>>();
    assert_eq!(outputs(&lines), outputs(&again));
}

/// Simulates a fault of the program.
struct Crashing(bool);

impl Progress for Crashing {
    fn module(&self, kind: ModuleKind, _: usize, _: usize) {
        assert!(!self.0 || kind != ModuleKind::Chain, "the program is wrong");
    }
}

struct Watcher {
    told: Mutex<Vec<(String, Result<(), String>)>>,
    /// The first robot waits until this file exists. Later robots must still be reported later.
    last: PathBuf,
}

impl Observer for Watcher {
    fn begin(&self, job: &Job) -> Box<dyn Progress> {
        while job.name == "arm" && !self.last.exists() {
            std::thread::yield_now();
        }
        Box::new(Crashing(job.name == "leg-robot" || job.name == "arm"))
    }

    fn done(&self, job: &Job, outcome: &Result<Generated, GenerateError>) {
        let outcome = outcome.as_ref().map(|_| ()).map_err(|error| error.to_string());
        self.told.lock().unwrap().push((job.name.clone(), outcome));
    }
}

#[test]
fn a_crash_stops_nothing() {
    let folder = folder();
    let jobs = jobs(
        &["arm", "leg", "hand/left"].map(|name| folder.path().join(name)),
        &Default::default(),
    )
    .unwrap();
    let out = folder.path().join("out");
    let watcher = Watcher { told: Mutex::default(), last: out.join("deep-robot") };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap();
    let settings = Settings::default();
    let failed = pool.install(|| urdd_generate::batch::run(&jobs, &out, &settings, &watcher));
    assert_eq!(failed, 2);
    let told = watcher.told.into_inner().unwrap();
    let names: Vec<&str> = told.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["arm", "leg-robot", "deep-robot"], "in order");
    let crash = told[0].1.as_ref().unwrap_err();
    assert!(crash.contains("the program is wrong") && crash.contains("report it"), "{crash}");
    assert!(told[2].1.is_ok());
    let made: Vec<_> =
        fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(made, ["deep-robot"], "and no left-overs");
}

#[test]
fn names_tell_robots_apart() {
    let folder = folder();
    let names = |paths: &[PathBuf]| {
        let jobs = jobs(paths, &Default::default()).unwrap();
        let below = |path: &Path| path.strip_prefix(folder.path()).unwrap().display().to_string();
        jobs.iter().map(|job| (below(&job.source), job.name.clone())).collect::<Vec<_>>()
    };
    let found = names(&[folder.path().to_owned()]);
    let found: Vec<(&str, &str)> = found.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    assert_eq!(
        found,
        [
            ("arm/arm.urdf", "arm"),
            ("bad/broken.urdf", "broken"),
            ("bad/loose.urdf", "loose"),
            ("hand/Robot.urdf", &*format!("{}-hand-Robot", plain_parts(folder.path()))),
            ("hand/left/deep/robot.urdf", "deep-robot"),
            ("hand/robot.urdf", &*format!("{}-hand-robot_2", plain_parts(folder.path()))),
            ("leg/robot.urdf", "leg-robot"),
        ]
    );
    // Duplicate files count once; the order is that of the arguments.
    let arm = folder.path().join("arm/arm.urdf");
    assert_eq!(names(&[arm.clone(), folder.path().join("arm")]).len(), 1);
}

/// The parts of a path, as used in names.
fn plain_parts(path: &Path) -> String {
    let parts = path.components().skip(1);
    let parts = parts.map(|part| part.as_os_str().to_string_lossy().into_owned());
    let parts = parts.map(|part| part.trim_start_matches('.').to_owned());
    parts.collect::<Vec<_>>().join("-")
}

#[test]
fn shards_are_the_whole() {
    let folder = folder();
    let all = jobs(&[folder.path().to_owned()], &Default::default()).unwrap();
    let mut found = Vec::new();
    for number in 1..=3 {
        found.extend(Shard { number, of: 3 }.of(all.clone()));
    }
    assert_eq!(found.len(), all.len());
    assert!(all.iter().all(|job| found.contains(job)));
    let (_, lines) = run(folder.path(), &["--shard", "2/3"]);
    assert_eq!(lines.last().unwrap()["summary"]["robots"], 2);
    for wrong in ["0/3", "4/3", "1", "a/b"] {
        assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
    }
}

#[test]
fn exit_status_tells_usage_from_failure() {
    let folder = folder();
    let status = |arguments: &[&str]| {
        let output =
            urdd(&["generate"]).args(arguments).current_dir(folder.path()).output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    assert_eq!(status(&["arm/arm.urdf", "-o", "o1"]).0, Some(0));
    assert_eq!(status(&["bad/broken.urdf", "-o", "o2"]).0, Some(1));
    assert_eq!(status(&["nothing.urdf", "-o", "o3"]).0, Some(1));
    for (arguments, word) in [
        (&["arm/arm.urdf"] as &[&str], "--output"),
        (&["arm/arm.urdf", "-o", "o4", "--modules", "dofs"], "kinematics_samples"),
        (&["arm/arm.urdf", "-o", "o4", "--package", "x"], "NAME=PATH"),
        (&["arm/arm.urdf", "-o", "o4", "--package", "x=/no/such"], "not a folder"),
        (&["arm/arm.urdf", "-o", "o4", "--shard", "1/2"], "batches"),
        (&["arm/arm.urdf", "-o", "o4", "--samples", "0"], "from 1 to 100,000"),
        (&[".hidden/../readme.txt", "nothing", "-o", "o4"], "no such file"),
        (&["o1", "-o", "o4"], "`urdd validate` checks these"),
    ] {
        let (code, message) = status(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {message}");
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    assert!(!folder.path().join("o4").exists());
}

#[test]
fn folders_too_deep_to_search_are_named() {
    let folder = testkit::temporary::folder();
    let deep = folder.path().join("d/".repeat(33));
    fs::create_dir_all(&deep).unwrap();
    fs::write(folder.path().join("a.urdf"), "<robot name=\"a\"/>").unwrap();
    let error = jobs(&[folder.path().to_owned()], &Default::default()).unwrap_err().to_string();
    assert!(error.contains("more than 32 levels deep"), "{error}");
    fs::remove_dir(&deep).unwrap();
    assert_eq!(jobs(&[folder.path().to_owned()], &Default::default()).unwrap().len(), 1);
}
