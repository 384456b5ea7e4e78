//! Pipes, links, folders and files of a person where a command would write.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{files, mjcf};
use crate::program::urdd;

/// A command, and whether it is told `--force` what may be replaced. All that it writes is below `place`.
struct Writer {
    name: &'static str,
    arguments: &'static [&'static str],
    /// Whether links in the place of files are refused. A URDD and a site replace them.
    refuses_links: bool,
    has_force: bool,
}

const WRITERS: [Writer; 10] = [
    strict("import", &["import", "r.xml", "-o", "place/out"]),
    strict(
        "import with a report",
        &["import", "r.xml", "-o", "place", "--report", "place/report.json"],
    ),
    strict("mjcf", &["export", "mjcf", "urdd", "-o", "place/out.xml"]),
    strict("srdf", &["export", "srdf", "urdd", "-o", "place/out.srdf"]),
    strict("moveit", &["export", "moveit", "urdd", "-o", "place/out"]),
    strict("init", &["export", "init", "urdd", "-o", "place/out.toml"]),
    Writer { has_force: false, ..strict("page", &["view", "urdd", "--export", "place/page.html"]) },
    Writer {
        refuses_links: false,
        ..strict("generate", &["generate", "r.xml", "-o", "place/out", "--modules", "core"])
    },
    Writer {
        refuses_links: false,
        ..strict(
            "combine",
            &["combine", "urdd", "other", "--at", "end", "-o", "place/out", "--modules", "core"],
        )
    },
    Writer { has_force: false, ..strict("site", &["view", "urdd", "--export", "place/out"]) },
];

const fn strict(name: &'static str, arguments: &'static [&'static str]) -> Writer {
    Writer { name, arguments, refuses_links: true, has_force: true }
}

/// A folder with a description and a URDD.
fn workshop() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    fs::write(folder.path().join("r.xml"), mjcf(1)).unwrap();
    let (status, _, said) = urdd(&["generate", "r.xml", "-o", "urdd"], folder.path());
    assert_eq!(status, 0, "{said}");
    let other = "<robot name=\"other\"><link name=\"other\"/></robot>";
    fs::write(folder.path().join("other.urdf"), other).unwrap();
    let (status, _, said) = urdd(&["generate", "other.urdf", "-o", "other"], folder.path());
    assert_eq!(status, 0, "{said}");
    folder
}

impl Writer {
    /// Runs it: its status and what it said. It must end by itself.
    fn run(&self, folder: &Path, force: bool) -> (i32, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(self.arguments).current_dir(folder);
        command.env("TMPDIR", testkit::temporary::place());
        command.args(force.then_some("--force"));
        let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn();
        let (mut child, begun) = (child.unwrap(), Instant::now());
        while child.try_wait().unwrap().is_none() {
            if begun.elapsed() > Duration::from_secs(60) {
                child.kill().unwrap();
                panic!("{}: it hangs", self.name);
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        let output = child.wait_with_output().unwrap();
        (output.status.code().unwrap(), String::from_utf8_lossy(&output.stderr).into_owned())
    }

    /// What it writes: two files of each folder.
    fn written(&self, folder: &Path) -> Vec<PathBuf> {
        fs::create_dir(folder.join("place")).unwrap();
        let (status, said) = self.run(folder, false);
        assert_eq!(status, 0, "{}: {said}", self.name);
        let mut taken: Vec<PathBuf> = Vec::new();
        for (file, _) in files(&folder.join("place")) {
            let file = PathBuf::from(file);
            // One that is there is a person's.
            if file.ends_with(".gitattributes") {
                continue;
            }
            let beside = taken.iter().filter(|other| other.parent() == file.parent());
            if beside.count() < 2 {
                taken.push(file);
            }
        }
        fs::remove_dir_all(folder.join("place")).unwrap();
        taken
    }

    /// Puts something in the way, and runs it with and without `--force`: it is refused by name, and nothing changes.
    fn refuses(&self, folder: &Path, at: &Path, put: &dyn Fn(&Path)) {
        for force in [false, true] {
            if force && !self.has_force {
                continue;
            }
            let place = folder.join("place");
            fs::create_dir_all(place.join(at).parent().unwrap()).unwrap();
            put(&place.join(at));
            let before = (files(&place), files(&folder.join("elsewhere")));
            let (status, said) = self.run(folder, force);
            let now = (files(&place), files(&folder.join("elsewhere")));
            let case = format!("{}, {}, force {force}: {said}", self.name, at.display());
            // A note of `generate` on the file beside the URDD is not an error.
            let is_beside = self.name == "generate" && at.parent() == Some(Path::new(""));
            assert!(status == 1 || status == 2 || is_beside, "{case}");
            let is_named = said.contains(at.to_str().unwrap()) || said.contains("is not empty");
            assert!(is_named, "{case}");
            assert!(now.1 == before.1, "{case}: {now:?}");
            assert!(is_beside || now.0 == before.0, "{case}: {now:?}");
            fs::remove_dir_all(&place).unwrap();
        }
    }
}

#[test]
fn pipes_folders_and_links_are_refused_at_once_by_all_that_write() {
    let folder = workshop();
    let folder = folder.path();
    let elsewhere = folder.join("elsewhere");
    fs::create_dir_all(elsewhere.join("deep")).unwrap();
    fs::write(elsewhere.join("mine"), "mine").unwrap();
    for writer in &WRITERS {
        for at in writer.written(folder) {
            writer.refuses(folder, &at, &|place| {
                let made = Command::new("mkfifo").arg(place).status().unwrap();
                assert!(made.success());
            });
            writer.refuses(folder, &at, &|place| fs::create_dir(place).unwrap());
            if !writer.refuses_links {
                continue;
            }
            writer.refuses(folder, &at, &|place| symlink(elsewhere.join("mine"), place).unwrap());
            writer.refuses(folder, &at, &|place| symlink(elsewhere.join("new"), place).unwrap());
        }
    }
}

/// A link below what was named: in the place of each folder that is written.
#[test]
fn nothing_is_written_through_a_linked_folder() {
    let folder = workshop();
    let folder = folder.path();
    let elsewhere = folder.join("elsewhere");
    fs::create_dir_all(&elsewhere).unwrap();
    for writer in &WRITERS {
        let files = writer.written(folder);
        let folders = files.iter().flat_map(|file| file.ancestors().skip(1));
        // The folder that was named may be a link.
        let folders = folders.filter(|below| {
            let below = below.to_str().unwrap();
            !below.is_empty() && (below != "out" || writer.name == "mjcf")
        });
        let folders: std::collections::BTreeSet<&Path> = folders.collect();
        for at in folders {
            writer.refuses(folder, at, &|place| symlink(&elsewhere, place).unwrap());
        }
    }
}

#[test]
fn a_named_folder_may_be_a_link_and_files_of_a_person_stay() {
    let folder = workshop();
    let folder = folder.path();
    for writer in &WRITERS {
        fs::create_dir_all(folder.join("real/out")).unwrap();
        symlink("real", folder.join("place")).unwrap();
        let (status, said) = writer.run(folder, false);
        assert_eq!(status, 0, "{}: {said}", writer.name);
        let first = files(&folder.join("real"));
        assert!(!first.is_empty() && first.iter().all(|(name, _)| !name.contains(".urdd-")));
        // Once more changes nothing, and neither does a file of a person beside them.
        fs::write(folder.join("real/mine"), "mine").unwrap();
        let (status, said) = writer.run(folder, writer.name == "init");
        assert_eq!(status, 0, "{}: {said}", writer.name);
        let mut again = files(&folder.join("real"));
        again.retain(|(name, _)| name != "mine");
        assert!(again == first, "{}", writer.name);
        // Other content stays without `--force`, and so does everything else.
        if writer.refuses_links && writer.has_force {
            for (name, _) in first.iter().take(3) {
                fs::write(folder.join("real").join(name), "mine").unwrap();
                let before = files(&folder.join("real"));
                let (status, said) = writer.run(folder, false);
                assert_eq!(status, 2, "{}: {said}", writer.name);
                assert!(said.contains(name.as_str()), "{}: {said}", writer.name);
                assert!(files(&folder.join("real")) == before, "{}", writer.name);
                let (status, said) = writer.run(folder, true);
                assert_eq!(status, 0, "{}: {said}", writer.name);
                let now = fs::read(folder.join("real").join(name)).unwrap();
                assert_ne!(now, b"mine", "{}: {name}", writer.name);
            }
        }
        fs::remove_file(folder.join("place")).unwrap();
        fs::remove_dir_all(folder.join("real")).unwrap();
    }
}

/// `skips import` and `configurations import` replace files of modules.
#[test]
fn edits_of_a_urdd_are_not_written_through_links() {
    let folder = workshop();
    let folder = folder.path();
    let srdf = "<robot name=\"r\"><disable_collisions link1=\"a\" link2=\"x\" reason=\"mine\"/>\
                <group name=\"g\"><joint name=\"k\"/></group>\
                <group_state name=\"up\" group=\"g\"><joint name=\"k\" value=\"0.5\"/></group_state></robot>";
    fs::write(folder.join("r.srdf"), srdf).unwrap();
    for (command, module) in [
        ("skips", "link_shapes_modules/link_shapes_skips_module"),
        ("configurations", "named_configurations_module"),
    ] {
        let module = folder.join("urdd").join(module);
        assert!(module.is_dir(), "{module:?}");
        let elsewhere = folder.join("elsewhere");
        fs::rename(&module, &elsewhere).unwrap();
        symlink(&elsewhere, &module).unwrap();
        let before = files(folder);
        let (status, _, said) = urdd(&[command, "import", "r.srdf", "urdd"], folder);
        assert!(status != 0 && files(folder) == before, "{command}: {said}");
        fs::remove_file(&module).unwrap();
        fs::rename(&elsewhere, &module).unwrap();
        let (status, _, said) = urdd(&[command, "import", "r.srdf", "urdd"], folder);
        assert!(status == 0 && files(folder) != before, "{command}: {said}");
    }
}

/// The promise of reports: links are followed, and devices and pipes are written to.
#[test]
fn a_report_follows_links_and_is_written_to_pipes() {
    let folder = workshop();
    let folder = folder.path();
    symlink("there.json", folder.join("link.json")).unwrap();
    for (number, report) in ["link.json", "/dev/null", "link.json"].into_iter().enumerate() {
        let out = format!("out{number}");
        let run = ["import", "r.xml", "-o", &out, "--report", report, "--force"];
        let (status, _, said) = urdd(&run, folder);
        assert_eq!(status, 0, "{said}");
    }
    assert!(fs::read_to_string(folder.join("there.json")).unwrap().contains("\"robot\""));
    // One that is elsewhere stays without `--force`, and one in the place of the output ends.
    let run = ["import", "r.xml", "-o", "fresh", "--report", "r.xml"];
    let (status, _, said) = urdd(&run, folder);
    assert!(status == 2 && said.contains("r.xml already exists"), "{said}");
    assert!(!folder.join("fresh").exists());
    for report in ["./fresh", "fresh/../fresh/output", "./out0"] {
        let run = ["import", "r.xml", "-o", "fresh", "--report", report];
        let (status, _, said) = urdd(&run, folder);
        assert!(status == 0 || status == 2, "{said}");
    }
    assert!(fs::symlink_metadata(folder.join("link.json")).unwrap().is_symlink());
    let (status, _, _) = urdd(&["validate", "urdd", "--output", "link.json"], folder);
    assert_eq!(status, 0);
    assert!(fs::read_to_string(folder.join("there.json")).unwrap().contains("\"urdds\""));
}

/// A full disk, simulated by a limit on file size.
#[test]
#[cfg(target_os = "linux")]
fn an_import_onto_a_full_disk_leaves_nothing() {
    let folder = workshop();
    let folder = folder.path();
    fs::write(folder.join("r.xml"), mjcf(1).replace("home", &"x".repeat(2000))).unwrap();
    let import = |output: &str| {
        let script = "trap '' XFSZ; ulimit -f 1; exec \"$1\" import r.xml -o \"$2\" --force";
        let mut command = Command::new("sh");
        command.args(["-c", script, "sh", env!("CARGO_BIN_EXE_urdd"), output]);
        let output = command.current_dir(folder).output().unwrap();
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let before = files(folder);
    let (status, said) = import("new/below");
    assert_eq!(status, Some(2), "{said}");
    let is_said = said.contains("new/below/r.") && said.contains(": cannot be written");
    assert!(is_said, "{said}");
    assert!(files(folder) == before && !folder.join("new").exists());
    fs::create_dir(folder.join("old")).unwrap();
    for name in ["mine", "r.urdf"] {
        fs::write(folder.join("old").join(name), "mine").unwrap();
    }
    let before = files(folder);
    assert_eq!(import("old").0, Some(2));
    assert!(files(folder) == before);
}
