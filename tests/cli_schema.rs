//! `urdd schema` as its user sees it.

use std::fs;
use std::process::{Command, Output, Stdio};

fn urdd(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_urdd"))
        .arg("schema")
        .args(arguments)
        .output()
        .unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn lists_every_schema_in_aligned_columns() {
    let text = stdout(&urdd(&["list"]));
    let heading = text.lines().next().unwrap();
    let column = heading.find("folder").unwrap();
    for line in text.lines() {
        assert_eq!(&line[column - 2..column], "  ", "{line}");
        assert_ne!(&line[column..=column], " ", "{line}");
    }
    assert!(text.contains("creator_module@unversioned"));
    assert!(text.contains("bevy_modules/first_look_vis_module"));
}

#[test]
fn shows_a_schema_strict_or_open() {
    let strict = urdd(&["show", "dof_module@1.0.0"]);
    assert!(strict.status.success());
    assert!(stdout(&strict).contains("\"additionalProperties\": false"));
    let open = stdout(&urdd(&["show", "dof_module@1.0.0", "--open"]));
    assert!(!open.contains("additionalProperties"));
    assert!(open.contains("\"urn:urdd:schema:dof_module:1.0.0:open\""));
}

#[test]
fn an_unknown_id_is_a_usage_error_with_a_hint() {
    let output = urdd(&["show", "dof_module"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("did you mean `dof_module@1.0.0`"));
    assert!(stderr(&output).contains("urdd schema list"));
}

#[test]
fn checks_what_it_exports_and_says_how_to_mend_it() {
    let temporary = tempfile::tempdir().unwrap();
    let folder = temporary.path().join("deep").join("schemas");
    let path = folder.to_str().unwrap();
    let check = || urdd(&["check", path]);

    assert_eq!(
        check().status.code(),
        Some(2),
        "a folder that does not exist"
    );
    assert!(urdd(&["export", path]).status.success());
    assert_eq!(check().status.code(), Some(0), "{}", stdout(&check()));

    let chain = folder.join("chain_module/1.0.0.json");
    let text = fs::read_to_string(&chain).unwrap();
    fs::write(&chain, text.replace('\n', "\r\n")).unwrap();
    assert_eq!(
        check().status.code(),
        Some(0),
        "line ends of another system"
    );

    fs::write(&chain, "{}").unwrap();
    fs::remove_file(folder.join("dof_module/1.0.0.json")).unwrap();
    fs::write(folder.join("dof_module/2.0.0.json"), [0xff]).unwrap();
    let output = check();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stdout(&output),
        format!(
            "chain_module/1.0.0.json: not what the types write\n\
             dof_module/1.0.0.json: missing\n\
             dof_module/2.0.0.json: no published schema; remove it\n\
             repair: urdd schema export {path}\n"
        )
    );

    fs::remove_file(folder.join("dof_module/2.0.0.json")).unwrap();
    assert!(stdout(&urdd(&["export", path])).contains("2 written"));
    assert_eq!(check().status.code(), Some(0));
}

#[test]
fn a_reader_that_stops_early_is_no_fault() {
    // A pipe whose reading end is closed before the program writes.
    let mut child = Command::new(env!("CARGO_BIN_EXE_urdd"))
        .args(["schema", "show", "urdf_module@1.0.0"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "");
    assert!(output.status.success());
}
