//! What arguments a xacro file takes, by its text and its package.

use std::fs;
use std::path::Path;

use crate::arguments::{XacroArgument, arguments};
use crate::launch::choices;
use crate::settings::Settings;

fn write(root: &Path, files: &[(&str, &str)]) {
    for (path, text) in files {
        fs::create_dir_all(root.join(path).parent().unwrap()).unwrap();
        fs::write(root.join(path), text).unwrap();
    }
}

fn robot(content: &str) -> String {
    format!(
        "<robot name=\"$(arg title)\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}</robot>"
    )
}

fn found(root: &Path) -> Vec<(String, Option<String>, String, bool)> {
    let all = arguments(&root.join("arms/urdf/arm.urdf.xacro"), &Settings::default()).unwrap();
    let short = |one: XacroArgument| (one.name, one.default, one.values.join(" "), one.is_needed);
    all.into_iter().map(short).collect()
}

const MANIFEST: &str = "<package><name>arms</name></package>";

#[test]
fn values_are_those_with_all_files_and_an_argument_without_one_is_needed() {
    let folder = tempfile::tempdir().unwrap();
    let main = robot(
        "<!-- $(arg old) --><xacro:include filename=\"$(find arms)/urdf/inc/colours.xacro\"/>\
         <xacro:arg name=\"title\" default=\"my_arm\"/><xacro:arg name=\"type\" default=\"other\"/><xacro:arg name=\"dof\" default=\"7\"/>\
         <xacro:arg name=\"limits\" default=\"$(find arms)/config/$(arg type)/limits.yaml\"/>\
         <xacro:property name=\"p\" value=\"${xacro.load_yaml('$(find arms)/config/$(arg type)/physics.yaml')}\"/>\
         <xacro:property name=\"q\" value=\"$(find arms)/config/arm$(arg dof)_control.yaml\"/>\
         <xacro:property name=\"r\" value=\"$(find arms)/../../$(arg outside)\"/>",
    );
    let colours = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\
        <xacro:include filename=\"../arm.urdf.xacro\"/><link name=\"$(arg colour)\"/></robot>";
    let launch =
        "DeclareLaunchArgument(\n  'colour', # choices=[\n  choices=['red', \"blue\",], x=f(1))\n";
    write(
        folder.path(),
        &[
            ("secret", ""),
            ("arms/package.xml", MANIFEST),
            ("arms/urdf/arm.urdf.xacro", &main),
            ("arms/urdf/inc/colours.xacro", colours),
            ("arms/launch/view.launch.py", launch),
            ("arms/config/long/limits.yaml", ""),
            ("arms/config/long/physics.yaml", ""),
            ("arms/config/short/limits.yaml", ""),
            ("arms/config/short/physics.yaml", ""),
            ("arms/config/unfinished/limits.yaml", ""),
            ("arms/config/arm6_control.yaml", ""),
            ("arms/config/arm7_control.yaml", ""),
            ("arms/config/arm_gripper_control.yaml", ""),
        ],
    );
    let limits = "$(find arms)/config/$(arg type)/limits.yaml";
    let row = |name: &str, default: Option<&str>, values: &str, is_needed| {
        (name.to_owned(), default.map(str::to_owned), values.to_owned(), is_needed)
    };
    assert_eq!(
        found(folder.path()),
        [
            row("colour", None, "red blue", true),
            row("dof", Some("7"), "6 7", false),
            row("limits", Some(limits), "", false),
            row("outside", None, "", true),
            row("title", Some("my_arm"), "my_arm", true),
            row("type", Some("other"), "long short", true),
        ]
    );
}

#[test]
fn a_file_that_is_no_xml_is_said() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &[("a.xacro", "<robot"), ("b.xacro", "")]);
    for name in ["a.xacro", "b.xacro", "none.xacro"] {
        let why = arguments(&folder.path().join(name), &Settings::default()).unwrap_err();
        assert!(!why.to_string().is_empty());
    }
}

#[test]
fn choices_are_literal_lists_alone() {
    let found = |text: &str| choices(text).collect::<Vec<_>>();
    let one = |name: &str, values: &[&str]| {
        vec![(name.to_owned(), values.iter().map(|&value| value.to_owned()).collect::<Vec<_>>())]
    };
    assert_eq!(found("DeclareLaunchArgument(name=\"a\", choices=[\"x\"])"), one("a", &["x"]));
    assert_eq!(
        found("DeclareLaunchArgument(\"a\", default_value=f(\")\"), choices=['']),"),
        one("a", &[""])
    );
    for text in [
        "DeclareLaunchArgument(NAME, choices=['x'])",
        "DeclareLaunchArgument('a', choices=['x', KINDS])",
        "DeclareLaunchArgument('a', choices=KINDS)",
        "DeclareLaunchArgument('a', choices=['x' 'y'])",
        "DeclareLaunchArgument('a'), Other(choices=['x'])",
        "DeclareLaunchArgument('a",
    ] {
        assert_eq!(found(text), [], "{text}");
    }
}
