//! Signals and limits end each command, wherever it is. Each command waits here for what never comes, so that it ends by
//! neither luck nor the machine's speed: for a program, for its input, for a reader of its output, for another run that has
//! its target.
#![cfg(target_os = "linux")]

use std::fs;
use std::io::Write;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use tempfile::TempDir;
use testkit::robots::{made, our_robots};
use urdd_directory::cancellation::Cancellation;
use urdd_directory::take::take;
use urdd_directory::target_lock::TargetLock;

/// The longest time that a stopped program may need on a busy machine. What it waits for does not come before.
const BOUND: Duration = Duration::from_secs(60);

/// What a pipe of Linux takes before its writer waits.
const PIPE: usize = 1 << 16;

const ARM: &str = r#"<robot name="arm"><link name="base"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="hand"><collision><origin xyz="0 0 0.5"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="hand"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;

/// A folder with robots, and a program `xacro` that does not end.
struct Workshop(TempDir);

impl Workshop {
    fn new() -> Self {
        let shop = Workshop(testkit::temporary::folder());
        for folder in ["bin", "temporary", "robots"] {
            fs::create_dir(shop.at(folder)).unwrap();
        }
        fs::write(shop.at("bin/xacro"), "#!/bin/sh\nexec /bin/sleep 600\n").unwrap();
        fs::set_permissions(shop.at("bin/xacro"), fs::Permissions::from_mode(0o755)).unwrap();
        fs::write(shop.at("arm.urdf"), ARM).unwrap();
        fs::write(shop.at("slow.urdf.xacro"), ARM).unwrap();
        fs::write(shop.at("slow.srdf.xacro"), "<robot name=\"arm\"/>").unwrap();
        fs::write(shop.at("arm.xml"), "<mujoco model=\"arm\"><worldbody><body name=\"base\"><geom size=\"1\"/></body></worldbody></mujoco>")
            .unwrap();
        fs::write(
            shop.at("list.yml"),
            "collision_spheres:\n  block:\n    - {center: [0, 0, 0], radius: 0.1}\n",
        )
        .unwrap();
        let (_, single) = our_robots().into_iter().find(|(name, _)| name == "single_link").unwrap();
        let (_made, made) = made(&single);
        take(&made, &shop.at("urdd")).unwrap();
        shop
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_urdd"));
        command.args(words).current_dir(self.0.path());
        command.env("PATH", self.at("bin")).env("TMPDIR", self.at("temporary"));
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn start(&self, words: &[&str]) -> Started {
        Started(self.command(words).spawn().unwrap())
    }

    /// All files and folders, hidden ones too, besides those of the test.
    fn content(&self) -> Vec<String> {
        fn below(folder: &Path, root: &Path, found: &mut Vec<String>) {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                found.push(path.strip_prefix(root).unwrap().display().to_string());
                if path.is_dir() {
                    below(&path, root, found);
                }
            }
        }
        let mut found = Vec::new();
        below(self.0.path(), self.0.path(), &mut found);
        found.sort();
        found
    }
}

/// A pipe that takes nothing more, and its reader, who does not read.
fn full_pipe() -> (std::io::PipeReader, std::io::PipeWriter) {
    let (reader, mut writer) = std::io::pipe().unwrap();
    writer.write_all(&[b' '; PIPE]).unwrap();
    (reader, writer)
}

/// A program that is killed if a test ends before it.
struct Started(Child);

impl Started {
    /// Waits until the program listens for signals. SIGHUP is the last of them.
    fn listens(&mut self) {
        let begun = Instant::now();
        let status = format!("/proc/{}/status", self.0.id());
        loop {
            let text = fs::read_to_string(&status).unwrap_or_default();
            let caught = text.lines().find_map(|line| line.strip_prefix("SigCgt:"));
            let mask = u64::from_str_radix(caught.unwrap_or_default().trim(), 16).unwrap_or(0);
            if [1, 2, 15].iter().all(|signal| mask & (1 << (signal - 1)) != 0) {
                return;
            }
            assert!(begun.elapsed() < BOUND, "it does not listen: {text}");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn send(&self, signal: &str) {
        let status = Command::new("/bin/kill").args([signal, &self.0.id().to_string()]).status();
        assert!(status.unwrap().success());
    }

    /// Its exit status and standard error, once it has ended.
    fn end(mut self) -> (Option<i32>, String) {
        let begun = Instant::now();
        while self.0.try_wait().unwrap().is_none() {
            assert!(begun.elapsed() < BOUND, "it does not end");
            std::thread::sleep(Duration::from_millis(5));
        }
        let mut said = String::new();
        if let Some(mut stderr) = self.0.stderr.take() {
            std::io::Read::read_to_string(&mut stderr, &mut said).unwrap();
        }
        (self.0.wait().unwrap().code(), said)
    }

    fn stopped(mut self, signal: &str) -> (Option<i32>, String) {
        self.listens();
        self.send(signal);
        self.end()
    }
}

impl Drop for Started {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

const SIGNALS: [(&str, i32); 2] = [("-INT", 130), ("-TERM", 143)];

#[test]
fn one_signal_ends_whoever_waits_for_a_program() {
    let shop = Workshop::new();
    let before = shop.content();
    let commands: &[&[&str]] = &[
        &["generate", "slow.urdf.xacro", "-o", "out"],
        &["generate", "slow.urdf.xacro", "arm.urdf", "-o", "out"],
        &["lint", "slow.urdf.xacro"],
        &["lint", "--fix", "slow.urdf.xacro"],
        &["diff", "arm.urdf", "slow.urdf.xacro"],
        &["view", "--export", "out", "slow.urdf.xacro"],
        &["combine", "arm.urdf", "slow.urdf.xacro", "--at", "hand", "--xacro", "-o", "out"],
        &["picture", "slow.urdf.xacro", "-o", "out.png"],
        &["skips", "import", "slow.srdf.xacro", "urdd"],
        &["configurations", "import", "slow.srdf.xacro", "urdd"],
    ];
    for (number, words) in commands.iter().enumerate() {
        let (signal, status) = SIGNALS[number % 2];
        let (ended, said) = shop.start(words).stopped(signal);
        assert_eq!(ended, Some(status), "{words:?}: {said}");
        // Of a batch, robots that were done before stay.
        let _ = fs::remove_dir_all(shop.at("out/arm"));
        let _ = fs::remove_dir(shop.at("out"));
        assert_eq!(shop.content(), before, "{words:?}");
    }
}

/// None of these looks at a cancellation while it waits.
#[test]
fn one_signal_ends_whoever_waits_for_another_run() {
    let shop = Workshop::new();
    let on = Cancellation::default();
    fs::create_dir(shop.at("busy")).unwrap();
    fs::write(shop.at("busy/mine"), "mine").unwrap();
    let held = ["out", "urdd", "out.png", "arm.srdf", "busy/output"];
    let hold = |name: &&str| TargetLock::acquire(&shop.at(name), &on).unwrap();
    let locks: Vec<TargetLock> = held.iter().map(hold).collect();
    let before = shop.content();
    let commands: &[&[&str]] = &[
        &["import", "arm.xml", "-o", "out"],
        // It has a lock and a folder already, of the folder as a whole.
        &["import", "arm.xml", "-o", "busy"],
        &["export", "srdf", "urdd", "-o", "arm.srdf"],
        &["picture", "urdd", "-o", "out.png"],
        &["spheres", "import", "list.yml", "urdd"],
        &["configurations", "set", "urdd", "home"],
        &["generate", "arm.urdf", "-o", "out"],
        &["combine", "arm.urdf", "arm.urdf", "--at", "hand", "-o", "out"],
        &["view", "--export", "out", "urdd"],
        &["rehash", "urdd"],
    ];
    for (number, words) in commands.iter().enumerate() {
        let (signal, status) = SIGNALS[number % 2];
        let (ended, said) = shop.start(words).stopped(signal);
        assert_eq!(ended, Some(status), "{words:?}: {said}");
        assert_eq!(shop.content(), before, "{words:?}");
    }
    drop(locks);
}

#[test]
fn one_signal_ends_whoever_waits_for_input_or_for_a_reader() {
    let shop = Workshop::new();
    let before = shop.content();
    let reads: &[&[&str]] =
        &[&["generate", "-", "-o", "out"], &["check-collisions", "urdd", "--configurations", "-"]];
    let writes: &[&[&str]] = &[
        &["lint", "arm.urdf"],
        &["validate", "urdd"],
        &["diff", "arm.urdf", "urdd"],
        &["info", "urdd"],
        &["export", "srdf", "urdd", "-o", "-"],
        &["check-collisions", "urdd"],
        &["view", "urdd", "--no-open"],
    ];
    let all =
        reads.iter().map(|words| (words, true)).chain(writes.iter().map(|words| (words, false)));
    for (number, (words, is_reader)) in all.enumerate() {
        let (signal, status) = SIGNALS[number % 2];
        let (_reader, full) = full_pipe();
        let mut command = shop.command(words);
        match is_reader {
            true => command.stdin(Stdio::piped()),
            false => command.stdout(full),
        };
        // A signal is how a server ends.
        let status = if words[0] == "view" { 0 } else { status };
        let (ended, said) = Started(command.spawn().unwrap()).stopped(signal);
        assert_eq!(ended, Some(status), "{words:?}: {said}");
        assert_eq!(shop.content(), before, "{words:?}");
    }
}

/// The program has to be ended from outside, while other threads write robots.
#[test]
fn what_is_unfinished_is_removed_and_what_is_finished_is_whole() {
    let shop = Workshop::new();
    for number in 0..40 {
        let robot = ARM.replace("\"arm\"", &format!("\"arm{number}\""));
        fs::write(shop.at(&format!("robots/arm{number}.urdf")), robot).unwrap();
    }
    let before = shop.content();
    let (_reader, full) = full_pipe();
    let mut command =
        shop.command(&["generate", "robots", "-o", "out", "--threads", "2", "--modules", "core"]);
    let started = Started(command.stdout(full).spawn().unwrap());
    let begun = Instant::now();
    let is_made = || fs::read_dir(shop.at("out")).is_ok_and(|made| made.count() > 0);
    while !is_made() {
        assert!(begun.elapsed() < BOUND, "it never began");
        std::thread::sleep(Duration::from_millis(1));
    }
    let (ended, said) = started.stopped("-TERM");
    assert_eq!(ended, Some(143), "{said}");
    let made: Vec<PathBuf> = fs::read_dir(shop.at("out"))
        .into_iter()
        .flatten()
        .map(|entry| entry.unwrap().path())
        .collect();
    assert!(made.len() < 40, "it was done before it was stopped");
    for urdd in made {
        assert_eq!(crate::generate::findings_of(&urdd), [], "{}", urdd.display());
    }
    let _ = fs::remove_dir_all(shop.at("out"));
    assert_eq!(shop.content(), before);
}

fn ended(mut command: Command) -> Output {
    command.output().unwrap()
}

#[test]
fn a_run_beyond_its_limits_ends_and_says_which() {
    let shop = Workshop::new();
    let before = shop.content();
    let lock = TargetLock::acquire(&shop.at("out"), &Cancellation::default()).unwrap();
    let limited: &[(&[&str], &str)] = &[
        (&["diff", "arm.urdf", "slow.urdf.xacro"], "slow.urdf.xacro"),
        (&["picture", "slow.urdf.xacro", "-o", "out.png"], "slow.urdf.xacro"),
        // This one does not look.
        (&["import", "arm.xml", "-o", "out"], "arm.xml"),
    ];
    for (words, robot) in limited {
        let output = ended(shop.command(&[words, &["--max-time", "0.5"] as &[&str]].concat()));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{words:?}: {said}");
        let words = format!(
            "urdd: {robot}: not finished within 0.5 s, the limit of --max-time; raise it for a robot that you trust\n"
        );
        assert_eq!(said, words);
    }
    // The program itself takes more.
    let output = ended(shop.command(&["diff", "arm.urdf", "slow.urdf.xacro", "--max-memory", "1"]));
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("slow.urdf.xacro: more than 1 MB of memory"), "{said}");
    drop(lock);
    assert_eq!(shop.content(), before);
}

/// One that is slow does not end the others.
#[test]
fn in_a_batch_others_have_their_results() {
    let shop = Workshop::new();
    let robots = ["robots/a.urdf", "robots/b.urdf.xacro", "robots/c.urdf"];
    robots.iter().for_each(|robot| fs::write(shop.at(robot), ARM).unwrap());
    // Long enough for an arm of two links on a busy machine.
    let limit = ["--xacro", "--max-time", "20"];
    let lint = ["lint", "robots", "--format", "json"];
    let (lint, generate) = std::thread::scope(|scope| {
        let generate = scope.spawn(|| {
            ended(
                shop.command(
                    &[&["generate", "robots", "-o", "out", "--modules", "core"] as &[&str], &limit]
                        .concat(),
                ),
            )
        });
        (ended(shop.command(&[&lint as &[&str], &limit].concat())), generate.join().unwrap())
    });
    assert_eq!(lint.status.code(), Some(1), "{lint:?}");
    let report: serde_json::Value = serde_json::from_slice(&lint.stdout).unwrap();
    let told = |at: usize| {
        let one = &report["urdds"][at];
        (one["path"].as_str().unwrap(), one["verdict"].as_str().unwrap(), one["reason"].as_str())
    };
    let reason =
        "not finished within 20 s, the limit of --max-time; raise it for a robot that you trust";
    assert_eq!(told(1), ("b.urdf.xacro", "unreadable", Some(reason)));
    for (at, path) in [(0, "a.urdf"), (2, "c.urdf")] {
        assert_eq!((told(at).0, told(at).2), (path, None));
        assert_ne!(report["urdds"][at]["checks"].as_array().map(Vec::len), Some(0));
    }
    assert_eq!(generate.status.code(), Some(1), "{generate:?}");
    for name in ["a", "c"] {
        assert_eq!(crate::generate::findings_of(&shop.at("out").join(name)), []);
    }
    assert!(!shop.at("out/b").exists());
    let said = String::from_utf8_lossy(&generate.stderr).into_owned();
    assert!(said.contains("robots/b.urdf.xacro: not finished within 20 s"), "{said}");
}

/// One that does not stop is left behind.
#[test]
fn in_a_batch_others_do_not_wait_for_one_that_does_not_stop() {
    let shop = Workshop::new();
    for name in ["a", "slow", "z"] {
        fs::write(shop.at("one.urdf"), ARM.replace("\"arm\"", &format!("\"{name}\""))).unwrap();
        let out = format!("robots/{name}");
        let words = ["generate", "one.urdf", "-o", &out, "--modules", "core"];
        assert!(ended(shop.command(&words)).status.success());
    }
    let words = ["validate", "robots", "--with-slow-rule", "--max-time", "6", "--format", "json"];
    let output = ended(shop.command(&words));
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let told = report["urdds"].as_array().unwrap().iter();
    let told: Vec<_> = told.map(|one| (&one["path"], &one["verdict"])).collect();
    assert_eq!(
        serde_json::json!(told),
        serde_json::json!([["a", "pass"], ["slow", "unreadable"], ["z", "pass"]])
    );
    // Alone, it ends the run by a signal too.
    let words = ["validate", "robots/slow", "--with-slow-rule"];
    assert_eq!(shop.start(&words).stopped("-INT").0, Some(130));
}

#[test]
fn a_server_has_no_limits() {
    let shop = Workshop::new();
    for words in [["lsp", "--max-time", "1"], ["view", "urdd", "--max-memory=1"]] {
        let output = ended(shop.command(&words));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!((output.status.code(), said.contains("a server")), (Some(2), true), "{said}");
    }
}
