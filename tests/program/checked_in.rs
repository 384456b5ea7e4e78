//! URDFs beside the xacro files that make them (LNT067), with a program in place of xacro that expands nothing.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::generate::urdd;

const XACRO: &str = "#!/bin/sh\nfor word; do case \"$word\" in mass:=*) mass=\"${word#mass:=}\";; *) file=\"$word\";; esac; done\n\
    if grep -q FAILS \"$file\"; then echo 'error: no mass' >&2; exit 2; fi\n\
    sed \"s/MASS/${mass:-5.5}/\" \"$file\"\n";

fn cases() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("crates/urdd-lint/tests/cases/LNT067")
}

/// A folder with the program and these files.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    for (path, text) in [&[("bin/xacro", XACRO)][..], files].concat() {
        let path = folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    fs::set_permissions(folder.path().join("bin/xacro"), fs::Permissions::from_mode(0o755))
        .unwrap();
    folder
}

/// For each file that is examined, the codes that are found; and what is said beside.
fn lint(root: &Path, words: &[&str]) -> (Vec<(String, Vec<String>)>, String) {
    let words = [&["lint", "--format", "json"], words].concat();
    let output = urdd(&words)
        .current_dir(root)
        .env("PATH", format!("{}:/usr/bin:/bin", root.join("bin").display()))
        .output()
        .unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let codes = |urdf: &Value| {
        let findings = urdf["findings"].as_array().unwrap().iter();
        findings.map(|one| one["code"].as_str().unwrap().to_owned()).collect()
    };
    let files = report["urdds"].as_array().unwrap().iter();
    let files = files.map(|one| (one["path"].as_str().unwrap().to_owned(), codes(one))).collect();
    (files, String::from_utf8(output.stderr).unwrap())
}

fn case(name: &str) -> String {
    fs::read_to_string(cases().join(name)).unwrap()
}

#[test]
fn the_rule_finds_its_fault_and_no_near_miss() {
    for (name, codes) in [("invalid", &["LNT067"][..]), ("near_miss", &[])] {
        let (urdf, xacro) = (case(&format!("{name}.urdf")), case(&format!("{name}.xacro")));
        let folder = folder(&[("arm.urdf", &urdf), ("arm.xacro", &xacro)]);
        for words in [&["arm.urdf", "--xacro"][..], &["arm.xacro"], &["arm.xacro", "--xacro"]] {
            let (files, said) = lint(folder.path(), words);
            assert_eq!(
                files,
                [(words[0].to_owned(), codes.iter().map(ToString::to_string).collect())],
                "{words:?} {said}"
            );
        }
        // Nobody asks for xacro.
        let (files, said) = lint(folder.path(), &["arm.urdf"]);
        assert_eq!(files, [("arm.urdf".to_owned(), Vec::new())]);
        assert!(
            said.contains(
                "1 xacro file was not compared with the `.urdf` of the same name: `arm.xacro`"
            ),
            "{said}"
        );
    }
}

#[test]
fn a_robot_that_is_checked_in_is_examined_once_unless_it_is_another_one() {
    let urdf = case("invalid.urdf");
    // Faults of both.
    let faulty = |name: &str| case(name).replace("value=\"2\"", "value=\"-2\"");
    let of_both = |xacro: &str| {
        folder(&[("a/arm.urdf", &faulty("invalid.urdf")), ("a/arm.urdf.xacro", &faulty(xacro))])
    };
    let same = of_both("near_miss.xacro");
    let (files, said) = lint(same.path(), &["a", "--xacro"]);
    assert_eq!(files.len(), 1, "{files:?}");
    assert!(!files[0].1.is_empty() && !files[0].1.contains(&"LNT067".to_owned()), "{files:?}");
    assert!(
        said.contains(
            "1 xacro file makes the `.urdf` of the same name, which is examined: `a/arm.urdf.xacro`"
        ),
        "{said}"
    );
    let other = of_both("invalid.xacro");
    let (files, _) = lint(other.path(), &["a", "--xacro"]);
    let stale: Vec<bool> =
        files.iter().map(|(_, codes)| codes.contains(&"LNT067".to_owned())).collect();
    assert_eq!(stale, [true, false], "{files:?}");
    // One that is not made is not compared, which is said.
    let fails = folder(&[
        ("a/arm.urdf", &urdf),
        ("a/arm.xacro", &case("invalid.xacro").replace("5.5", "FAILS")),
    ]);
    let output = urdd(&["lint", "a", "--xacro"])
        .current_dir(fails.path())
        .env("PATH", format!("{}:/usr/bin:/bin", fails.path().join("bin").display()))
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(said.contains("LNT067: `arm.xacro` beside it was not made: "), "{said}");
    assert!(said.contains("error: no mass"), "{said}");
}

#[test]
fn one_of_the_declared_robots_may_be_the_one_that_is_checked_in() {
    let xacro = case("invalid.xacro").replace("5.5", "MASS");
    let declared = "[[robot]]\npath = \"a/arm.xacro\"\nargs = { mass = [\"5\", \"7\"] }\n";
    let folder = folder(&[
        ("a/arm.urdf", &case("invalid.urdf")),
        ("a/arm.xacro", &xacro),
        ("urdd.toml", declared),
    ]);
    let (files, said) = lint(folder.path(), &["a", "--xacro"]);
    let none = Vec::<String>::new();
    assert_eq!(
        files,
        [("arm.urdf".to_owned(), none.clone()), ("arm.xacro".to_owned(), none)],
        "{said}"
    );
    fs::remove_file(folder.path().join("urdd.toml")).unwrap();
    let (files, _) = lint(folder.path(), &["a", "--xacro"]);
    assert_eq!(files[0].1, ["LNT067"]);
}

#[test]
fn calls_of_a_xacro_file_beside_its_urdf_count() {
    let robot = |content: &str| {
        format!(
            "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}</robot>"
        )
    };
    let main = robot("<xacro:include filename=\"parts.xacro\"/><xacro:arm/>");
    let parts = robot("<xacro:macro name=\"arm\"><link name=\"a\"/></xacro:macro>");
    let folder = folder(&[
        ("a/arm.urdf", &case("invalid.urdf")),
        ("a/arm.xacro", &main),
        ("a/parts.xacro", &parts),
    ]);
    let (_, said) = lint(folder.path(), &["a"]);
    assert!(
        said.contains("1 file defines macros") && !said.contains("no robot here calls"),
        "{said}"
    );
}
