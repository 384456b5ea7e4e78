//! Robots that need arguments, and `[[robot]]` in `urdd.toml`, with a program in place of xacro.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use serde_json::Value;

use crate::generate::urdd;

const MAIN: &str = "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
    <xacro:arg name=\"type\" default=\"other\"/>\n\
    <xacro:property name=\"limits\" value=\"${xacro.load_yaml('$(find arms)/config/$(arg type)/limits.yaml')}\"/>\n\
    <link name=\"base\"/>\n</robot>\n";
/// As xacro, it needs the files of a type, and fails for one of them.
const XACRO: &str = "#!/bin/sh\nfor word; do case \"$word\" in type:=*) type=\"${word#type:=}\";; esac; done\n\
    case \"$type\" in long | short) echo \"<robot name='arm_$type'><link name='base'/></robot>\";;\n\
    *) echo \"error: no file\" >&2; exit 2;; esac\n";

/// A package with a robot of two types, and a third one that makes none.
pub fn package() -> tempfile::TempDir {
    let folder = testkit::temporary::folder();
    let root = folder.path();
    for (path, text) in [
        ("arms/package.xml", "<package><name>arms</name></package>"),
        ("arms/urdf/arm.urdf.xacro", MAIN),
        ("arms/config/broken/limits.yaml", ""),
        ("arms/config/long/limits.yaml", ""),
        ("arms/config/short/limits.yaml", ""),
        ("bin/xacro", XACRO),
    ] {
        fs::create_dir_all(root.join(path).parent().unwrap()).unwrap();
        fs::write(root.join(path), text).unwrap();
    }
    fs::set_permissions(root.join("bin/xacro"), fs::Permissions::from_mode(0o755)).unwrap();
    folder
}

fn run(root: &Path, words: &[&str]) -> (Option<i32>, String) {
    let output = urdd(words).current_dir(root).env("PATH", root.join("bin")).output().unwrap();
    let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), said.concat())
}

#[test]
fn a_robot_that_needs_arguments_is_an_information_and_its_lines_are_written() {
    let folder = package();
    let root = folder.path();
    // Nothing was examined.
    let (status, said) = run(root, &["lint", "arms", "--xacro"]);
    assert_eq!(status, Some(2), "{said}");
    for words in [
        "info LNT065 needs-arguments",
        "arm.urdf.xacro:2:1 (argument `type`)",
        "`type` (broken, long, short)",
        "[[robot]] path = \"arms/urdf/arm.urdf.xacro\" args = { type = [\"broken\", \"long\", \"short\"] }",
        "xacro says: error: no file",
        "1 URDF: 1 not examined.",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    // Nobody asked for it: what was examined beside it decides.
    fs::write(root.join("arms/urdf/other.urdf"), testkit::robots::BARS).unwrap();
    let (status, said) = run(root, &["lint", "arms", "--xacro"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("2 URDFs: 1 passed, 1 not examined."), "{said}");
    // A person who names it did.
    let named = ["lint", "arms/urdf/arm.urdf.xacro", "arms/urdf/other.urdf"];
    let (status, said) = run(root, &named);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("error LNT065 needs-arguments"), "{said}");
    fs::remove_file(root.join("arms/urdf/other.urdf")).unwrap();
    let own = "# ours\n[severity]\nLNT001 = \"info\"\n";
    fs::write(root.join("urdd.toml"), own).unwrap();
    let (status, said) = run(root, &["lint", "arms", "--xacro", "--write-robots"]);
    assert_eq!(status, Some(0), "{said}");
    let lines = "\n[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nargs = { type = [\"long\", \"short\"] }\n";
    assert_eq!(fs::read_to_string(root.join("urdd.toml")).unwrap(), format!("{own}{lines}"));
    // Whoever runs it again adds nothing.
    let (status, said) = run(root, &["lint", "arms", "--xacro", "--write-robots"]);
    assert_eq!((status, said.trim()), (Some(0), "urdd.toml: nothing to add"));
    assert_eq!(fs::read_to_string(root.join("urdd.toml")).unwrap(), format!("{own}{lines}"));
}

/// An argument was renamed: its old name is still in urdd.toml.
#[test]
fn a_declared_robot_that_can_no_longer_be_made_fails_and_is_in_no_baseline() {
    let folder = package();
    let root = folder.path();
    let declared =
        "[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nargs = { kind = [\"long\", \"short\"] }\n";
    fs::write(root.join("urdd.toml"), declared).unwrap();
    fs::write(root.join("arms/urdf/other.urdf"), testkit::robots::BARS).unwrap();
    let words = ["lint", "arms", "--xacro"];
    // xacro cannot make it.
    let (status, said) = run(root, &words);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("3 URDFs: 1 passed, 2 not examined."), "{said}");
    let (status, said) = run(root, &["lint", "arms", "--xacro", "--write-baseline", "base.json"]);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("arm.urdf.xacro kind:=long: not examined: "), "{said}");
    let (status, said) = run(root, &["lint", "arms", "--xacro", "--baseline", "base.json"]);
    assert_eq!(status, Some(1), "{said}");
}

#[test]
fn conditions_that_make_no_tree_are_named_and_tried() {
    let folder = package();
    let root = folder.path();
    let main = "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n\
        <xacro:arg name=\"cell_1\" default=\"false\"/><xacro:arg name=\"cell_2\" default=\"false\"/>\n\
        <link name=\"world\"/><link name=\"base\"/>\n\
        <xacro:if value=\"$(arg cell_1)\"/><xacro:if value=\"$(arg cell_2)\"/></robot>\n";
    fs::write(root.join("arms/urdf/arm.urdf.xacro"), main).unwrap();
    // With the first it makes a tree, with the second still none.
    let script = "#!/bin/sh\necho \"<robot name='arm'><link name='world'/><link name='base'/>\"\n\
        for word; do case \"$word\" in cell_1:=true) echo \"<joint name='j' type='fixed'><parent link='world'/><child link='base'/></joint>\";; esac; done\n\
        echo '</robot>'\n";
    fs::write(root.join("bin/xacro"), script).unwrap();
    let (_, said) = run(root, &["lint", "arms", "--xacro"]);
    let words = "or give another value of an argument that conditions ask for: `cell_1` (true, false), `cell_2` (true, false)";
    assert!(said.contains("error URD004") && said.contains(words), "{said}");
    run(root, &["lint", "arms", "--xacro", "--write-robots"]);
    let lines = "[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nargs = { cell_1 = \"true\" }";
    assert_eq!(fs::read_to_string(root.join("urdd.toml")).unwrap().trim(), lines);
}

#[test]
fn a_part_that_nobody_is_known_to_include_is_said() {
    let folder = package();
    let root = folder.path();
    let part =
        "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><link name=\"tool_${PI}\"/></robot>";
    fs::write(root.join("arms/urdf/frames.urdf.xacro"), part).unwrap();
    let (status, said) = run(root, &["lint", "arms/urdf", "--xacro"]);
    assert_ne!(status, Some(0), "{said}");
    assert!(said.contains("its `<robot>` has no name, so it may be a part"), "{said}");
    // Of a file that a person names, that is no answer.
    let (_, said) = run(root, &["lint", "arms/urdf/frames.urdf.xacro"]);
    assert!(!said.contains("may be a part"), "{said}");
}

#[test]
fn where_a_package_is_missing_it_is_said_and_no_argument() {
    let folder = package();
    let root = folder.path();
    let said_of = |name: &str| {
        let script = format!(
            "#!/bin/sh\necho \"error: package '{name}' not found, searching: []\" >&2\nexit 2\n"
        );
        fs::write(root.join("bin/xacro"), script).unwrap();
        run(root, &["lint", "arms", "--xacro"])
    };
    let (status, said) = said_of("hands");
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("the package `hands` is not around the file"), "{said}");
    assert!(!said.contains("LNT065"), "{said}");
    // Another value of the argument would name another package.
    let (status, said) = said_of("other_description");
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("LNT065"), "{said}");
    // That of an argument without default could, unless the file names the package.
    let main = MAIN.replace(" default=\"other\"", "");
    let file = root.join("arms/urdf/arm.urdf.xacro");
    fs::write(&file, &main).unwrap();
    let (status, said) = said_of("hands");
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("LNT065"), "{said}");
    let include = "<xacro:include filename=\"$(find hands)/hand.xacro\"/><link";
    fs::write(&file, main.replace("<link", include)).unwrap();
    let (status, said) = said_of("hands");
    assert_eq!(status, Some(2), "{said}");
    assert!(!said.contains("LNT065"), "{said}");
}

#[test]
fn an_argument_that_decides_whether_a_property_is_there_is_needed() {
    let folder = package();
    let root = folder.path();
    let write = |undefined: &str, default: &str| {
        let side = |value: &str, property: &str| {
            format!(
                "<xacro:if value=\"${{own == '{value}'}}\"><xacro:property name=\"{property}\" value=\"1\"/></xacro:if>"
            )
        };
        let sides = [side("left", "corner"), side("right", "corner"), side("top", "lid")].concat();
        let main = format!(
            "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n<xacro:arg name=\"side\" default=\"{default}\"/>\n\
            <xacro:arg name=\"hand\" default=\"no\"/><xacro:property name=\"own\" value=\"$(arg side)\"/>\n{sides}\n\
            <link name=\"base_${{corner}}\"/></robot>\n"
        );
        fs::write(root.join("arms/urdf/arm.urdf.xacro"), main).unwrap();
        let script = format!(
            "#!/bin/sh\nfor word; do case \"$word\" in side:=left | side:=right)\n\
            echo \"<robot name='arm'><link name='base'/></robot>\"; exit 0;; esac; done\n\
            echo \"error: name '{undefined}' is not defined\" >&2\nexit 2\n"
        );
        fs::write(root.join("bin/xacro"), script).unwrap();
    };
    write("corner", "");
    let (status, said) = run(root, &["lint", "arms", "--xacro"]);
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("arm.urdf.xacro:2:1 (argument `side`)"), "{said}");
    assert!(said.contains("the robot needs `side` (left, right); "), "{said}");
    run(root, &["lint", "arms", "--xacro", "--write-robots"]);
    let lines = "\n[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nargs = { side = [\"left\", \"right\"] }\n";
    assert_eq!(fs::read_to_string(root.join("urdd.toml")).unwrap().trim(), lines.trim());
    fs::remove_file(root.join("urdd.toml")).unwrap();
    // No argument decides about this one, and the default of this argument defines it.
    for (undefined, default) in [("edge", ""), ("corner", "left")] {
        write(undefined, default);
        let (status, said) = run(root, &["lint", "arms", "--xacro"]);
        assert_eq!(status, Some(2), "{said}");
        assert!(!said.contains("LNT065") && said.contains("is not defined"), "{said}");
    }
}

#[test]
fn declared_robots_are_linted_and_named_in_every_form() {
    let folder = package();
    let root = folder.path();
    let toml =
        "[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nargs = { type = [\"long\", \"short\"] }\n";
    fs::write(root.join("urdd.toml"), toml).unwrap();
    let (status, said) = run(root, &["lint", "arms", "--xacro"]);
    assert_eq!(status, Some(0), "{said}");
    assert!(said.contains("urdf/arm.urdf.xacro type:=long pass  robot \"arm_long\""), "{said}");
    assert!(said.contains("urdf/arm.urdf.xacro type:=short pass  robot \"arm_short\""), "{said}");
    for form in ["junit", "markdown"] {
        let (_, said) = run(root, &["lint", "arms", "--xacro", "--format", form]);
        assert!(said.contains("type:=long") && said.contains("type:=short"), "{form}: {said}");
    }
    let (_, said) = run(root, &["lint", "arms", "--xacro", "--format", "json"]);
    let report: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(report["urdds"][1]["xacro_arguments"], serde_json::json!(["type:=short"]));
    // A xacro file of a folder runs only where somebody says so, whatever a file in the folder declares.
    let (status, said) = run(root, &["lint", "arms"]);
    assert_eq!(status, Some(2), "{said}");
    // Somebody who names one names its robots; with arguments, one.
    let (_, said) = run(root, &["lint", "arms/urdf/arm.urdf.xacro"]);
    assert!(said.contains("2 URDFs: 2 passed"), "{said}");
    let (_, said) = run(root, &["lint", "arms/urdf/arm.urdf.xacro", "type:=long"]);
    assert!(said.contains("1 URDF: 1 passed"), "{said}");
}

#[test]
fn declared_robots_are_generated_each_by_its_name() {
    let folder = package();
    let root = folder.path();
    let toml = "[[robot]]\npath = \"arms/urdf/arm.urdf.xacro\"\nname = \"a\"\nargs = { type = [\"long\", \"short\"] }\n";
    fs::write(root.join("robots.toml"), toml).unwrap();
    for source in ["arms", "arms/urdf/arm.urdf.xacro"] {
        let out = format!("out_{}", source.len());
        let words = ["generate", source, "-o", &out, "--config", "robots.toml"];
        let (status, said) = run(root, &words);
        assert_eq!(status, Some(0), "{said}");
        for name in ["long", "short"] {
            let text = fs::read_to_string(root.join(format!("{out}/a_{name}/urdd.json"))).unwrap();
            assert!(text.contains(&format!("\"arm_{name}\"")), "{text}");
        }
    }
    let (status, said) = run(root, &["generate", "arms", "-o", "none"]);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("values are missing for `type` (broken, long, short)"), "{said}");
}

#[test]
fn each_side_of_a_diff_has_its_own_arguments() {
    let folder = package();
    let root = folder.path();
    let [arm, other] = ["arms/urdf/arm.urdf.xacro", "arms/urdf/other.urdf.xacro"];
    fs::copy(root.join(arm), root.join(other)).unwrap();
    // As git has one, for the time of a difftool.
    fs::copy(root.join(arm), root.join("before.urdf.xacro")).unwrap();
    fs::write(root.join("plain.urdf"), "<robot name='arm_long'><link name='base'/></robot>\n")
        .unwrap();
    let declare = |kinds: &str| {
        let toml = format!(
            "[[robot]]\npath = \"{arm}\"\nargs = {{ type = {kinds} }}\n\
            [[robot]]\npath = \"{other}\"\nargs = {{ type = \"short\" }}\n"
        );
        fs::write(root.join("robots.toml"), toml).unwrap();
    };
    let diff = |before: &str, after: &str| {
        run(root, &["diff", before, after, "--no-findings", "--config", "robots.toml"])
    };
    declare("\"long\"");
    let (status, said) = diff(arm, other);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("arm_long") && said.contains("arm_short"), "{said}");
    for (before, after) in [(arm, "plain.urdf"), ("before.urdf.xacro", other)] {
        let (status, said) = diff(before, after);
        assert_eq!(status, Some(0), "{before}: {said}");
    }
    declare("[\"long\", \"short\"]");
    let (status, said) = diff(arm, "plain.urdf");
    assert_eq!(status, Some(2), "{said}");
    assert!(said.contains("robots.toml declares 2 robots of it"), "{said}");
}

#[test]
fn info_lists_the_arguments_and_runs_nothing() {
    let folder = package();
    let root = folder.path();
    fs::remove_file(root.join("bin/xacro")).unwrap();
    let (status, said) = run(root, &["info", "arms"]);
    assert_eq!(status, Some(0), "{said}");
    let expected =
        "arms/urdf/arm.urdf.xacro\n  type = \"other\", needs a value: broken, long, short\n\n";
    assert_eq!(said, expected);
    let (_, said) = run(root, &["info", "arms", "--format", "json"]);
    let all: Value = serde_json::from_str(&said).unwrap();
    assert_eq!(all[0]["arguments"][0]["values"], serde_json::json!(["broken", "long", "short"]));
}
