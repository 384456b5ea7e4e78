//! `urdd conformance validator`, with our validator as the one under test, and with some faulty ones.

use std::fs;

use serde_json::{Value, json};
use urdd_conformance::export::items;
use urdd_conformance::suite::CaseKind;

use crate::conformance::{conformance, result, stderr};

const URDD: &str = env!("CARGO_BIN_EXE_urdd");

fn run(cases: &[&str], more: &[&str], command: &[&str]) -> (i32, Value) {
    let only: Vec<&str> = cases.iter().flat_map(|case| ["--case", case]).collect();
    let start = ["validator", "--format", "json", "--timeout", "20"];
    result(&[&start[..], &only, more, &["--"], command].concat())
}

fn shell(cases: &[&str], script: &str) -> (i32, Value) {
    run(cases, &[], &["sh", "-c", script, "sh", "{dir}"])
}

#[test]
fn ours_is_right() {
    let command = [URDD, "validate", "{dir}"];
    let cases = ["DOF", "LEG", "SRC00", "DIR016", "DIR024", "valid/gripper"];
    let (status, result) = run(&cases, &[], &command);
    assert_eq!((status, &result["passed"]), (0, &true.into()), "{result:#}");
    assert_eq!(result["totals"]["right"], result["totals"]["of"]);
    assert!(result["totals"]["of"].as_u64() > Some(50));
    assert_eq!(result["families"][1]["name"], "DOF");
}

/// Every case, for `.ci/run`.
#[test]
#[ignore = "takes a minute; .ci/run runs it"]
fn ours_is_right_everywhere() {
    let (status, result) = run(&[], &[], &[URDD, "validate", "{dir}"]);
    assert_eq!(status, 0, "{result:#}");
    assert!(result["totals"]["of"].as_u64() > Some(500));
}

#[test]
fn verdicts_are_told_apart() {
    let cases = ["DOF001", "DOF002", "valid/single_link"];
    let (_, right) = run(&cases, &[], &[URDD, "validate", "{dir}"]);
    let of = right["totals"]["of"].as_u64().expect("a number");
    let (status, all_accepted) = shell(&cases, "exit 0");
    let missed = all_accepted["totals"]["missed"].as_u64().expect("a number");
    assert_eq!(status, 1);
    assert!(missed > 2 && missed < of);
    assert_eq!(all_accepted["sound"]["false_alarms"], 0);
    let (_, all_rejected) = shell(&cases, "exit 1");
    assert_eq!(all_rejected["totals"]["false_alarms"], json!(of - missed));
    assert_eq!(all_rejected["totals"]["missed"], 0);
    assert_eq!(all_rejected["sound"]["false_alarms"], json!(of - missed));
    // Another status, a signal, or a missing program is not a verdict.
    for script in ["exit 2", "exit 101", "kill -9 $$"] {
        let (status, none) = shell(&cases, script);
        assert_eq!((status, &none["totals"]["undecided"]), (1, &json!(of)), "{script}");
    }
    let (_, none) = run(&cases, &[], &["/no/such/validator", "{dir}"]);
    assert_eq!(none["totals"]["undecided"], json!(of));
    let end = none["wrong"][0]["end"].as_str().expect("text");
    assert!(end.contains("could not be started"), "{end}");
}

#[test]
fn printed_codes_are_scored_apart() {
    let cases = ["DOF001", "SRC001", "LEG001", "valid/single_link"];
    let (_, right) = run(&cases, &[], &[URDD, "validate", "{dir}"]);
    let codes = &right["printed_codes"];
    assert_eq!(codes["right"], codes["of"], "{codes:#}");
    assert_eq!((&codes["missing"], &codes["extra"]), (&json!([]), &json!([])));
    // Without valid URDDs, legacy cases, and cases of a SHOULD.
    let suite = urdd::suite::carried().expect("the suite reads");
    let of = |code: &str, kind| {
        let items = items(&suite).expect("the cases read").into_iter();
        let items = items.filter(|item| item.code.as_deref() == Some(code) && item.kind == kind);
        let items = items.filter(|item| item.profile == "1.0");
        items.map(|item| item.id).collect::<Vec<String>>()
    };
    let missing = of("DOF001", CaseKind::Invalid);
    let near = ["DOF001", "SRC001", "LEG001"].map(|code| of(code, CaseKind::NearMiss).len());
    assert_eq!(codes["of"], missing.len() + near.iter().sum::<usize>());

    // The right verdicts with wrong codes pass. The paths that it prints are not codes.
    let script = "echo \"in $1: DOF002, SRC001\"; exec \"$0\" validate --quiet --format json \"$1\" > /dev/null";
    let (status, wrong) = run(&cases, &[], &["sh", "-c", script, URDD, "{dir}"]);
    assert_eq!((status, &wrong["totals"]), (0, &right["totals"]));
    assert_eq!(wrong["printed_codes"]["missing"], json!(missing));
    let extra = of("SRC001", CaseKind::NearMiss);
    assert_eq!(wrong["printed_codes"]["extra"], json!(extra));
    let (_, silent) = shell(&cases, "exit 1");
    assert_eq!(silent["printed_codes"], Value::Null);

    let start = ["validator", "--case", "DOF001", "--"];
    let said = |script| {
        let command = ["sh", "-c", script, "sh", "{dir}"];
        let output = conformance(&[&start[..], &command].concat());
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let shown = said("echo DOF002; exit 1");
    assert!(shown.contains("printed codes: ") && shown.contains("not printed: DOF001/"), "{shown}");
    assert!(!said("exit 1").contains("printed codes"));
}

#[test]
fn some_paths_are_relative() {
    let absolute = "case \"$1\" in /*) ;; *) exit 1;; esac; exec \"$0\" validate --quiet \"$1\"";
    let relative = ["relative", "valid/single_link", "DOF001"];
    let (status, found) = run(&relative, &[], &["sh", "-c", absolute, URDD, "{dir}"]);
    let wrong: Vec<&Value> = found["wrong"].as_array().into_iter().flatten().collect();
    assert_eq!((status, wrong.len()), (1, 1), "{found:#}");
    assert_eq!(
        (&wrong[0]["id"], &wrong[0]["fault"]),
        (&json!("relative/valid"), &json!("false_alarm"))
    );
    let accepted = "case \"$1\" in /*) ;; *) exit 0;; esac; exec \"$0\" validate --quiet \"$1\"";
    let (_, found) = run(&relative, &[], &["sh", "-c", accepted, URDD, "{dir}"]);
    assert_eq!(found["wrong"][0]["id"], "relative/invalid", "{found:#}");
    let (status, found) = run(&["relative"], &[], &[URDD, "validate", "{dir}"]);
    assert_eq!((status, &found["totals"]["right"]), (0, &json!(2)), "{found:#}");
    // Also for a folder that is kept, from the repository's folder.
    let folder = testkit::temporary::folder();
    let kept = folder.path().join("kept");
    let keep = ["--keep", kept.to_str().expect("UTF-8")];
    assert_eq!(run(&["relative"], &keep, &[URDD, "validate", "{dir}"]).0, 0);
    assert!(kept.join("relative/invalid/robot/urdd.json").is_file());
}

#[test]
#[ignore = "waits 11 s; .ci/run runs it"]
fn a_line_every_ten_seconds_where_no_terminal_is() {
    let start = ["validator", "--case", "valid/single_link", "--", "sh", "-c"];
    let said = stderr(&conformance(&[&start[..], &["sleep 11", "sh", "{dir}"]].concat()));
    assert_eq!(said, "0 of 1, 0 wrong\n");
}

#[test]
fn the_time_limit_is_no_verdict() {
    let command = ["sh", "-c", "sleep 60; exit 1", "sh", "{dir}"];
    let more = ["--timeout", "1"];
    let start = ["validator", "--format", "json", "--case", "valid/single_link"];
    let (status, result) = result(&[&start[..], &more, &["--"], &command].concat());
    assert_eq!(status, 1);
    assert_eq!(result["wrong"][0]["fault"], "undecided");
    assert_eq!(result["wrong"][0]["end"], "stopped at the time limit");
}

#[test]
fn skips_excuse_and_go_stale() {
    let folder = testkit::temporary::folder();
    let file = folder.path().join("skips");
    let skip = ["--skip", file.to_str().expect("UTF-8")];
    let accept = ["sh", "-c", "exit 0", "sh", "{dir}"];
    let cases = ["DOF001", "DOF002"];
    fs::write(&file, "DOF001 # soon\nDOF002 # soon\nBND # not run here\n").expect("written");
    let (status, result) = run(&cases, &skip, &accept);
    assert_eq!((status, &result["passed"]), (0, &true.into()), "{result:#}");
    assert_eq!(result["wrong"][0]["skipped_since"], "soon");
    assert_eq!(result["stale_skips"], json!([]));
    let (status, result) = run(&cases, &skip, &[URDD, "validate", "{dir}"]);
    assert_eq!(status, 1);
    assert_eq!(result["stale_skips"], json!(["DOF001", "DOF002"]));

    fs::write(&file, "DOF999 # why\n").expect("written");
    let start = ["validator", "--case", "DOF001"];
    let output = conformance(&[&start[..], &skip, &["--"], &accept].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("there is no `DOF999`"), "{}", stderr(&output));
}

#[test]
fn cases_are_of_versions() {
    let command = ["--", URDD, "validate", "{dir}"];
    let newer = ["validator", "--spec-version", "2.0.0"];
    let output = conformance(&[&newer[..], &command].concat());
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("no case to run"), "{}", stderr(&output));
    let minor = ["validator", "--format", "json", "--spec-version", "1.4.0"];
    let (status, _) = result(&[&minor[..], &["--case", "DOF001"], &command].concat());
    assert_eq!(status, 0);
}

/// The number of cases that were judged, of legacy URDDs too.
fn number_judged(result: &Value) -> usize {
    let of = |which: &str| result[which]["of"].as_u64().expect("a number") as usize;
    of("totals") + of("legacy")
}

#[test]
fn a_crash_that_ends_with_one_is_warned_of() {
    let cases = ["DOF001", "DOF002", "valid/single_link"];
    let crash = "echo 'Traceback (most recent call last):' >&2; exit 1";
    let (_, result) = shell(&cases, crash);
    assert_eq!(
        result["crashed"].as_array().map(Vec::len),
        Some(number_judged(&result)),
        "{result:#}"
    );
    let start = ["validator", "--case", "DOF001", "--"];
    let output = conformance(&[&start[..], &["sh", "-c", crash, "sh", "{dir}"]].concat());
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("look like crashes") && said.contains("--reject-status"), "{said}");
    // With a status of its own for rejections, it is no verdict.
    let (_, result) = run(&cases, &["--reject-status", "3"], &["sh", "-c", crash, "sh", "{dir}"]);
    assert_eq!(result["totals"]["undecided"], result["totals"]["of"]);
    assert_eq!(result["crashed"], json!([]));
    let (_, result) =
        run(&cases, &["--reject-status", "3"], &["sh", "-c", "exit 3", "sh", "{dir}"]);
    assert_eq!(result["totals"]["undecided"], 0);
    assert_eq!(result["totals"]["missed"], 0);
}

#[test]
fn legacy_is_counted_apart() {
    let command = [URDD, "validate", "{dir}"];
    let cases = ["LEG", "DOF001"];
    let (status, with) = run(&cases, &[], &command);
    assert_eq!(status, 0);
    let of = |result: &Value, sum: &str| result[sum]["of"].as_u64().expect("a number");
    assert!(of(&with, "legacy") > 5 && of(&with, "totals") > 1, "{with:#}");
    let (status, without) = run(&cases, &["--no-legacy"], &command);
    assert_eq!((status, of(&without, "legacy")), (0, 0));
    assert_eq!(of(&without, "totals"), of(&with, "totals"));
    // Faults with legacy URDDs do not change the score of version 1, but are reported.
    let script = "test -f \"$1/urdd.json\" || exit 2; exec \"$0\" validate \"$1\"";
    let (status, wrong) = run(&cases, &[], &["sh", "-c", script, URDD, "{dir}"]);
    assert_eq!((status, &wrong["totals"]), (1, &with["totals"]));
    assert_eq!(wrong["legacy"]["undecided"], wrong["legacy"]["of"]);
}

#[test]
fn results_are_logged_as_they_come_and_folders_can_stay() {
    let folder = testkit::temporary::folder();
    let (log, kept) = (folder.path().join("log"), folder.path().join("kept"));
    let more = ["--log", log.to_str().expect("UTF-8"), "--jobs", "1"];
    let keep = ["--keep", kept.to_str().expect("UTF-8")];
    // The second command to run kills the whole program, as a user would who has seen enough.
    let script = format!(
        "test -f '{0}' && kill -9 $PPID; touch '{0}'; exit 1",
        folder.path().join("ran").display()
    );
    let start = ["validator", "--case", "DOF001", "--case", "DOF002"];
    let output =
        conformance(&[&start[..], &more, &["--", "sh", "-c", &script, "sh", "{dir}"]].concat());
    assert_eq!(output.status.code(), None, "it was killed");
    let lines = fs::read_to_string(&log).expect("a log");
    let lines: Vec<Value> =
        lines.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    assert_eq!(lines.len(), 1, "{lines:?}");
    assert_eq!(lines[0]["end"], "exit status 1");
    assert!(lines[0]["id"].as_str().is_some_and(|id| id.starts_with("DOF001/")));

    let more = [&more[..], &keep, &["--no-legacy"]].concat();
    let (_, result) = run(&["DOF001"], &more, &[URDD, "validate", "{dir}"]);
    let of = number_judged(&result);
    let logged = fs::read_to_string(&log).expect("a log");
    assert_eq!(logged.lines().count(), of);
    let cases = fs::read_dir(kept.join("invalid/DOF001")).expect("what was kept");
    for case in cases {
        assert!(case.expect("an entry").path().join("robot/urdd.json").is_file());
    }
    // Never into a folder that is not empty.
    let again = conformance(&[&start[..], &keep, &["--", URDD, "validate", "{dir}"]].concat());
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("not empty"), "{}", stderr(&again));
    let full = ["--log", "/dev/full"];
    if cfg!(target_os = "linux") {
        let output = conformance(&[&start[..], &full, &["--", URDD, "validate", "{dir}"]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("/dev/full: cannot be written"), "{}", stderr(&output));
    }
}

/// Processes whose ids a script wrote into a folder, and that still run.
fn alive(folder: &std::path::Path) -> Vec<String> {
    let files = fs::read_dir(folder).expect("a folder");
    let pids =
        files.map(|file| fs::read_to_string(file.expect("a file").path()).expect("a number"));
    let runs = |pid: &String| {
        let stat = fs::read_to_string(format!("/proc/{}/stat", pid.trim())).unwrap_or_default();
        stat.rsplit_once(')').is_some_and(|(_, rest)| !rest.starts_with(" Z"))
    };
    pids.filter(runs).collect()
}

/// A command whose children differ: in its group, in sessions of their own, without a parent, and without an
/// environment. Each writes its process id into the folder.
fn family(folder: &std::path::Path, last: &str) -> String {
    let child =
        |name: &str| format!("sh -c 'echo $$ > {}/{name}; exec sleep 600'", folder.display());
    format!(
        "{} & setsid {} & (setsid {} &) & (env -i setsid {} &) & setsid sh -c \"(setsid {} &) & sleep 600\" & {last}",
        child("group"),
        child("session"),
        child("orphan"),
        child("bare"),
        child("deep").replace('$', "\\$"),
    )
}

#[test]
#[cfg(target_os = "linux")]
fn a_signal_ends_all_that_was_started() {
    use std::time::{Duration, Instant};
    // Where these tests run under `nohup`, a process that they start ignores SIGHUP too, unless it is told otherwise.
    let told = ["--default-signal=HUP", "--ignore-signal=HUP"];
    let signals = [("TERM", 143, 0), ("INT", 130, 0), ("HUP", 129, 0), ("TERM", 143, 1)];
    for (signal, status, ignored) in signals {
        let folder = testkit::temporary::folder();
        let script = family(folder.path(), "sleep 600");
        let mut run = std::process::Command::new("env")
            .args([told[ignored], URDD])
            .args(["conformance", "validator", "--case", "DOF001", "--jobs", "1"])
            .args(["--", "sh", "-c", &script, "sh", "{dir}"])
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("the program");
        let start = Instant::now();
        while alive(folder.path()).len() < 5 && start.elapsed() < Duration::from_secs(60) {
            std::thread::sleep(Duration::from_millis(20));
        }
        assert_eq!(alive(folder.path()).len(), 5);
        let pid = run.id().to_string();
        let send = |signal: &str| {
            let sent = std::process::Command::new("kill").args(["-s", signal, &pid]).status();
            assert!(sent.expect("kill").success());
        };
        if ignored == 1 {
            send("HUP");
            std::thread::sleep(Duration::from_millis(300));
            assert_eq!(alive(folder.path()).len(), 5, "an ignored SIGHUP");
        }
        send(signal);
        assert_eq!(run.wait().expect("a status").code(), Some(status));
        assert_eq!(alive(folder.path()), [] as [String; 0], "SIG{signal}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn whatever_a_command_started_ends_with_it() {
    for (last, end) in
        [("sleep 600", "stopped at the time limit"), ("sleep 1; exit 7", "exit status 7")]
    {
        let folder = testkit::temporary::folder();
        let script = family(folder.path(), last);
        let command = ["sh", "-c", &script, "sh", "{dir}"];
        let start =
            ["validator", "--format", "json", "--case", "valid/single_link", "--timeout", "2"];
        let (_, result) = result(&[&start[..], &["--"], &command].concat());
        assert_eq!(result["wrong"][0]["end"], end);
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 5);
        assert_eq!(alive(folder.path()), [] as [String; 0], "{last}");
    }
}

#[test]
fn a_log_replaces_no_other_file() {
    let folder = testkit::temporary::folder();
    let file = folder.path().join("thesis.tex");
    let log = ["--log", file.to_str().expect("UTF-8")];
    let start = ["validator", "--case", "DOF001"];
    let command = ["--", "sh", "-c", "exit 1", "sh", "{dir}"];
    let run = |more: &[&str]| conformance(&[&start[..], &log, more, &command].concat());
    for text in ["my thesis\n", "{}\n", "{\"end\": 1}\n", "[1]"] {
        fs::write(&file, text).expect("written");
        let output = run(&[]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("is not a log of this command"), "{}", stderr(&output));
        assert_eq!(fs::read_to_string(&file).expect("a file"), text);
    }
    assert_ne!(run(&["--force"]).status.code(), Some(2));
    let logged = fs::read_to_string(&file).expect("a log");
    assert!(logged.starts_with("{\"id\":\"DOF001/"), "{logged}");
    // It overwrites its own log, and an empty file too.
    assert_ne!(run(&[]).status.code(), Some(2));
    fs::write(&file, "").expect("written");
    assert_ne!(run(&[]).status.code(), Some(2));
    assert_eq!(run(&["--output", log[1]]).status.code(), Some(2));
    let metadata = folder.path().join("urdd.json");
    let named = ["--log", metadata.to_str().expect("UTF-8")];
    let output = conformance(&[&start[..], &named, &command].concat());
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(!metadata.exists());
}
