//! Xacro files, by a program of that name that stands on the PATH.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use crate::{findings_of, read_json, urdd};

const EXPANDED: &str =
    "<?xml version=\"1.0\"?>\n<robot name=\"expanded\"><link name=\"a\"/></robot>\n";

fn run(folder: &Path, source: &str, program: Option<&str>) -> (Option<i32>, String) {
    let programs = folder.join("bin");
    fs::create_dir_all(&programs).unwrap();
    if let Some(script) = program {
        let path = programs.join("xacro");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
    let output = urdd(&["generate", "-o"])
        .arg(folder.join("out"))
        .arg(folder.join(source))
        .env("PATH", programs)
        .output()
        .unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

#[test]
fn is_expanded_by_the_program() {
    let folder = tempfile::tempdir().unwrap();
    let source = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:arm/></robot>";
    fs::write(folder.path().join("arm.urdf.xacro"), source).unwrap();
    fs::write(folder.path().join("expanded"), EXPANDED).unwrap();
    // It is given the file, and writes the URDF.
    let script = "case \"$1\" in *arm.urdf.xacro) while read -r line; do echo \"$line\"; done < \"${1%/*}/expanded\";; *) exit 3;; esac";
    let (status, said) = run(folder.path(), "arm.urdf.xacro", Some(script));
    assert_eq!(status, Some(0), "{said}");
    let out = folder.path().join("out");
    assert_eq!(fs::read_to_string(out.join("arm.urdf")).unwrap(), EXPANDED);
    assert_eq!(
        fs::read_to_string(out.join("arm.urdf.as-found")).unwrap(),
        source
    );
    assert_eq!(read_json(&out.join("urdd.json"))["robot_name"], "expanded");
    assert_eq!(findings_of(&out), []);
}

#[test]
fn without_the_program_the_message_says_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let (status, said) = run(folder.path(), "arm.xacro", None);
    assert_eq!(status, Some(1));
    assert!(said.contains("pip install xacro"), "{said}");
    assert!(!folder.path().join("out").exists());
}

#[test]
fn what_the_program_says_is_passed_on() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("arm.xacro"), EXPANDED).unwrap();
    let (status, said) = run(
        folder.path(),
        "arm.xacro",
        Some("echo 'no such package: arm' >&2; exit 2"),
    );
    assert_eq!(status, Some(1));
    assert!(said.contains("no such package: arm"), "{said}");
}
