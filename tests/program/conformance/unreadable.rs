//! `urdd conformance validator`: the third verdict, and the profile `core-json`.

use serde_json::{Value, json};

use crate::conformance::{conformance, result};

const URDD: &str = env!("CARGO_BIN_EXE_urdd");
const OURS: [&str; 3] = [URDD, "validate", "{dir}"];

fn run(more: &[&str], command: &[&str]) -> (i32, Value) {
    let start = ["validator", "--format", "json", "--timeout", "60"];
    result(&[&start[..], more, &["--"], command].concat())
}

fn shell(more: &[&str], script: &str) -> (i32, Value) {
    run(more, &["sh", "-c", script, URDD, "{dir}"])
}

/// A few of them: the largest inflate to 100 MB.
const SOME: [&str; 6] =
    ["--case", "unreadable/d", "--case", "unreadable/e", "--case", "unreadable/f"];

fn number(result: &Value, key: &str) -> u64 {
    result["unreadable"][key].as_u64().unwrap_or_else(|| panic!("{key}: {result:#}"))
}

#[test]
fn ours_tells_what_cannot_be_read() {
    let (status, result) = run(&["--case", "unreadable"], &OURS);
    assert_eq!((status, &result["passed"]), (0, &true.into()), "{result:#}");
    assert_eq!(number(&result, "right"), number(&result, "of"));
    assert!(number(&result, "of") > 40);
    // They count nowhere else.
    assert_eq!((&result["totals"]["of"], &result["families"]), (&json!(0), &json!([])));
}

/// A validator without a status for it, and one that does not look.
#[test]
fn rejecting_is_right_until_a_status_is_asked_for() {
    let rejects = "\"$0\" validate --quiet \"$1\"; test $? = 0";
    let (status, result) = shell(&SOME, rejects);
    assert_eq!((status, &result["unreadable"]["wrong"]), (0, &json!([])), "{result:#}");
    let rejected = number(&result, "rejected");
    assert!(rejected > 5 && rejected + number(&result, "right") == number(&result, "of"));

    let strict = [&SOME[..], &["--unreadable-status", "2"]].concat();
    let (status, result) = shell(&strict, rejects);
    let wrong = result["unreadable"]["wrong"].as_array().expect("a list");
    assert_eq!((status, wrong.len() as u64), (1, rejected));
    assert!(wrong.iter().all(|case| case["fault"] == "rejected"), "{wrong:#?}");
    assert_eq!(result["wrong"], json!([]));

    let (status, result) = shell(&SOME, "exit 0");
    assert_eq!((status, number(&result, "missed")), (1, rejected));
    assert_eq!(number(&result, "false_alarms"), 0);
    let near = number(&result, "right");
    for says in ["exit 1", "exit 2"] {
        let (_, result) = shell(&SOME, says);
        assert_eq!(number(&result, "false_alarms"), near, "{says}");
    }
    let (_, result) = shell(&SOME, "exit 3");
    assert_eq!(number(&result, "undecided"), number(&result, "of"));
}

#[test]
fn the_status_is_the_validators_own() {
    let script =
        "\"$0\" validate --quiet \"$1\"; status=$?; test $status = 2 && exit 9; exit $status";
    let own = [&SOME[..], &["--unreadable-status", "9"]].concat();
    assert_eq!(shell(&own, script).0, 0);
    assert_eq!(shell(&SOME, script).0, 1);
}

/// Old cases have the results that they had: 2 is no verdict on a URDD that can be read.
#[test]
fn other_cases_are_judged_as_before() {
    let (_, result) = shell(&["--case", "DOF001"], "exit 2");
    assert_eq!(result["totals"]["undecided"], result["totals"]["of"]);
    assert_eq!(number(&result, "of"), 0);
    let output = conformance(&[
        "validator",
        "--no-unreadable",
        "--case",
        "unreadable",
        "--",
        "true",
        "{dir}",
    ]);
    assert_eq!(output.status.code(), Some(2), "no case is left");
}

#[test]
fn a_batch_answers_with_the_status() {
    let script =
        "while read -r dir; do \"$0\" validate --quiet \"$dir\" > /dev/null 2>&1; echo $?; done";
    let strict = [&SOME[..], &["--batch", "--unreadable-status", "2"]].concat();
    let (status, result) = run(&strict, &["sh", "-c", script, URDD]);
    assert_eq!((status, number(&result, "right")), (0, number(&result, "of")), "{result:#}");
}

#[test]
fn skips_name_one_or_all() {
    let folder = testkit::temporary::folder();
    let file = folder.path().join("skips");
    let skip = [&SOME[..], &["--skip", file.to_str().expect("UTF-8")]].concat();
    std::fs::write(&file, "unreadable # no archives yet\n").expect("written");
    let (status, result) = shell(&skip, "exit 0");
    assert_eq!(status, 0, "{result:#}");
    assert_eq!(result["unreadable"]["wrong"][0]["skipped_since"], "no archives yet");
    std::fs::write(&file, "unreadable/empty-folder # soon\n").expect("written");
    assert_eq!(run(&skip, &OURS).1["stale_skips"], json!(["unreadable/empty-folder"]));
}

/// Go and OCaml end with 2 when nobody catches what they raise.
#[test]
fn a_crash_that_looks_unreadable_is_warned_of() {
    for crash in ["Fatal error: exception Not_found", "panic: oops\n\ngoroutine 18 [running]:"] {
        let script = format!("printf '{crash}\n' >&2; exit 2");
        let (_, result) = shell(&SOME, &script);
        let crashed = result["crashed_unreadable"].as_array().map(Vec::len);
        assert_eq!(
            (crashed, &result["crashed"]),
            (Some(number(&result, "of") as usize), &json!([]))
        );
        let output = conformance(
            &[&["validator"], &SOME[..], &["--", "sh", "-c", &script, "sh", "{dir}"]].concat(),
        );
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            said.contains("look like crashes") && said.contains("--unreadable-status"),
            "{said}"
        );
        // With a status of its own, it is no verdict.
        let own = [&SOME[..], &["--unreadable-status", "9"]].concat();
        let (_, result) = shell(&own, &script);
        assert_eq!(number(&result, "undecided"), number(&result, "of"));
        assert_eq!(result["crashed_unreadable"], json!([]));
    }
}

#[test]
fn people_read_how_many_were_told() {
    let said = |command: &[&str]| {
        let output = conformance(&[&["validator"], &SOME[..], &["--"], command].concat());
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let right = said(&OURS);
    assert!(right.contains("what cannot be read: ") && right.contains("passed"), "{right}");
    let rejected = said(&["sh", "-c", "exit 1", "sh", "{dir}"]);
    assert!(rejected.contains("rejected: --unreadable-status"), "{rejected}");
    assert!(rejected.contains("unreadable/dots-in-a-name FALSE ALARM"), "{rejected}");
}

/// Our validator without the rules that the profile passes over is right on its cases, and on no others.
#[test]
fn a_validator_of_core_modules_is_right_on_its_profile() {
    let passed_over = "YML,EXT,MSH,SHP,LRN,LEG,DIR010,DIR030";
    let command = [URDD, "validate", "--ignore", passed_over, "{dir}"];
    let cases = ["YML001", "DIR012", "EXT001", "DOF001", "MSH001", "unreadable/e", "relative/"];
    let only: Vec<&str> = cases.iter().flat_map(|case| ["--case", case]).collect();
    let profile = [&only[..], &["--profile", "core-json"]].concat();
    let (status, result) = run(&profile, &command);
    assert_eq!((status, &result["profile"]), (0, &json!("core-json")), "{result:#}");
    let names: Vec<&Value> =
        result["families"].as_array().into_iter().flatten().map(|family| &family["name"]).collect();
    assert_eq!(names, ["DIR", "DOF"]);
    assert_eq!(number(&result, "of"), 1, "archives are not of the profile");
    let (status, whole) = run(&only, &command);
    assert_eq!((status, &whole["profile"]), (1, &Value::Null));
    let wrong = whole["wrong"].as_array().into_iter().flatten();
    let wrong: Vec<&str> = wrong.filter_map(|case| case["id"].as_str()).collect();
    assert!(wrong.iter().any(|id| id.starts_with("YML001/")), "{wrong:?}");
}

#[test]
fn a_validator_of_a_class_is_right_on_its_profile() {
    let passed_over = "MSH,SHP,LRN,SPH,LEG,SRC007";
    let command = [URDD, "validate", "--ignore", passed_over, "{dir}"];
    let cases = ["YML001", "EXT00", "DIR01", "DIR023", "MSH001", "SPH001", "unreadable/d"];
    let only: Vec<&str> = cases.iter().flat_map(|case| ["--case", case]).collect();
    let (status, result) = run(&[&only[..], &["--profile", "core"]].concat(), &command);
    assert_eq!((status, &result["class"], &result["profile"]), (0, &json!("Core"), &Value::Null));
    let names: Vec<&Value> =
        result["families"].as_array().into_iter().flatten().map(|family| &family["name"]).collect();
    assert_eq!(names, ["DIR", "EXT", "YML"], "{result:#}");
    assert!(number(&result, "of") > 5, "archives are of the class");
}
