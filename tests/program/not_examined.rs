//! What was not examined is not good: no command calls it so, in any format, and no baseline holds it.

use std::fs;
use std::path::Path;

use serde_json::Value;
use testkit::robots::BARS;

use crate::program::urdd;

/// Each command that looks at something, by words in which `X` is what it looks at.
const COMMANDS: [&[&str]; 15] = [
    &["generate", "X", "-o", "out"],
    &["combine", "X", "X", "--at", "base", "-o", "out"],
    &["import", "X", "-o", "out"],
    &["validate", "X"],
    &["lint", "X"],
    &["diff", "X", "X"],
    &["check-collisions", "X"],
    &["view", "X", "--export", "out"],
    &["picture", "X", "-o", "out.png"],
    &["export", "srdf", "X", "-o", "out.srdf"],
    &["skips", "import", "right.srdf", "X"],
    &["spheres", "import", "right.yml", "X"],
    &["configurations", "list", "X"],
    &["info", "X"],
    &["rehash", "X"],
];
/// Commands that look at no robot.
const OTHERS: [&str; 6] = ["conformance", "lsp", "explain", "schema", "completions", "help"];

fn inputs(folder: &Path) -> Vec<String> {
    const POINTER: &str =
        "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a2146\nsize 12345\n";
    fs::write(folder.join("right.srdf"), "<robot name=\"bars\"/>").expect("written");
    fs::write(folder.join("right.yml"), "collision_spheres: {a: [{center: [0, 0, 0], radius: 1}]}")
        .expect("written");
    let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".as_slice();
    let files: [(&str, &[u8]); 5] = [
        ("empty.urdf", b""),
        ("pointer.urdf", POINTER.as_bytes()),
        ("picture.urdf", png),
        ("pointer.usda", POINTER.as_bytes()),
        ("broken/urdd.json", b"{"),
    ];
    fs::create_dir(folder.join("broken")).expect("a folder");
    fs::create_dir(folder.join("nothing")).expect("a folder");
    for (name, bytes) in files {
        fs::write(folder.join(name), bytes).expect("written");
    }
    let names = files.iter().map(|(name, _)| name.trim_end_matches("/urdd.json").to_owned());
    names.chain(["nothing".to_owned(), "gone.urdf".to_owned()]).collect()
}

#[test]
fn no_command_calls_good_what_it_cannot_examine() {
    let folder = testkit::temporary::folder();
    let inputs = inputs(folder.path());
    for command in COMMANDS {
        for input in &inputs {
            let words = command.iter().map(|word| if *word == "X" { input } else { *word });
            let words: Vec<&str> = words.collect();
            let (status, out, said) = urdd(&words, folder.path());
            // A site shows a URDD that cannot be read, with its findings.
            if command[0] == "view" && input == "broken" {
                let (status, ..) = urdd(&["validate", "broken"], folder.path());
                assert_eq!(status, 1);
                continue;
            }
            assert!(status != 0 && status != 101, "{words:?}: status {status}: {out}{said}");
            assert!(!out.contains(" pass") || out.contains("0 pass"), "{words:?}: {out}{said}");
            assert!(!(out + &said).trim().is_empty(), "{words:?} says nothing");
        }
    }
}

#[test]
fn each_command_that_looks_at_a_robot_is_tried() {
    let (_, help, _) = urdd(&["--help"], Path::new("."));
    let list = help.split("Commands:").nth(1).expect("commands").split("Options:").next();
    let lines = list.expect("commands").lines();
    let names = lines.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = names.filter_map(|line| line.split_whitespace().next());
    for name in names {
        let is_tried = COMMANDS.iter().any(|words| words[0] == name) || OTHERS.contains(&name);
        assert!(is_tried, "add {name} to COMMANDS, or to OTHERS if it looks at no robot");
    }
}

#[test]
fn every_report_says_what_was_not_examined_where_and_why() {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    fs::write(root.join("bars.urdf"), BARS).expect("written");
    // Without the program `xacro`, nothing is known of it.
    let arm = "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><link name=\"a\"/></robot>";
    fs::write(root.join("arm.xacro"), arm).expect("written");
    let lint = |words: &[&str], status: i32| {
        let mut command = crate::generate::urdd(&["lint"]);
        let output = command.args(words).current_dir(root).env("PATH", root).output();
        let output = output.expect("the program");
        let out = String::from_utf8(output.stdout).expect("UTF-8");
        assert_eq!(output.status.code(), Some(status), "{words:?}: {out}");
        out
    };
    let both = |format: &str| lint(&["bars.urdf", "arm.xacro", "--format", format], 1);
    let json: Value = serde_json::from_str(&both("json")).expect("JSON");
    let [right, arm] = [&json["urdds"][0], &json["urdds"][1]];
    assert_eq!((&right["verdict"], &right["not_examined"]), (&"pass".into(), &Value::Null));
    assert_eq!(
        (&arm["verdict"], &arm["not_examined"]["cause"]),
        (&"unreadable".into(), &"unreadable".into())
    );
    assert_eq!(arm["not_examined"]["is_asked_for"], true);
    let totals = ["urdds", "passed", "failed", "not_examined"].map(|key| &json["totals"][key]);
    assert_eq!(totals, [2, 1, 0, 1]);
    let people = both("human");
    assert!(people.contains("arm.xacro NOT EXAMINED"), "{people}");
    assert!(people.contains("2 URDFs: 1 passed, 1 not examined."), "{people}");
    let why = "needs the program `xacro`";
    let github = both("github");
    assert!(
        github.contains("::error file=arm.xacro,title=not examined::arm.xacro: expanding"),
        "{github}"
    );
    let markdown = both("markdown");
    assert!(markdown.contains("2 URDFs, 0 failed, 1 not examined"), "{markdown}");
    assert!(markdown.contains("| not examined: `` arm.xacro: expanding this file"), "{markdown}");
    let junit = both("junit");
    assert!(junit.contains("errors=\"1\"") && junit.contains(why), "{junit}");
    let sarif: Value = serde_json::from_str(&both("sarif")).expect("JSON");
    let results = sarif["runs"][0]["results"].as_array().expect("results");
    let open = results.iter().filter(|result| result["ruleId"] == "not-examined");
    let open: Vec<&Value> = open.collect();
    assert_eq!((open.len(), &open[0]["level"]), (1, &"error".into()), "{results:?}");
    let artifact = &open[0]["locations"][0]["physicalLocation"]["artifactLocation"];
    assert_eq!(artifact["uri"], "arm.xacro");
    // A baseline holds what was found, and never what was not looked at.
    lint(&["bars.urdf", "arm.xacro", "--write-baseline", "base.json"], 1);
    lint(&["bars.urdf", "arm.xacro", "--baseline", "base.json"], 1);
    lint(&["arm.xacro", "--write-baseline", "none.json"], 2);
    assert!(!root.join("none.json").exists());
    // No rule was asked for that is about a URDF.
    let out = lint(&["bars.urdf", "--select", "MSH", "--format", "json"], 2);
    let json: Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(json["urdds"][0]["not_examined"]["cause"], "no-rule");
}

#[test]
fn where_json_is_asked_for_a_refusal_is_json_too() {
    let folder = testkit::temporary::folder();
    for words in [
        &["lint", "gone.urdf", "--format", "json"][..],
        &["validate", "gone", "--format=json"],
        &["info", "gone", "--format", "json"],
        &["diff", "gone.urdf", "gone.urdf", "--format", "json"],
        &["import", "gone.xml", "-o", "out", "--format", "json"],
        &["export", "srdf", "gone", "-o", "out.srdf", "--format", "json"],
        &["lint", "gone.urdf", "--format", "json", "--no-such-option"],
    ] {
        let (status, out, said) = urdd(words, folder.path());
        assert_eq!(status, 2, "{words:?}: {out}{said}");
        let json: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{words:?}: {out}"));
        let message = json["error"]["message"].as_str().expect("a message");
        assert!(said.contains(message.lines().next().expect("a line")), "{message}: {said}");
    }
}

/// `--report` and `--format` are typed where a command has none; what they are like must not destroy.
#[test]
fn no_tip_names_what_destroys() {
    let folder = testkit::temporary::folder();
    for command in COMMANDS {
        for wrong in ["--report", "--format", "--forc", "--drop", "--drop-edit", "--fi", "--alon"] {
            let mut words = command.to_vec();
            words.push(wrong);
            let (status, _, said) = urdd(&words, folder.path());
            assert_eq!(status, 2, "{words:?}: {said}");
            let tip = said.split("tip:").nth(1).unwrap_or_default();
            for destructive in ["'--force'", "'--drop-edits'", "'--fix'", "'--alone'"] {
                assert!(!tip.contains(destructive), "{words:?}: {said}");
            }
        }
    }
}
