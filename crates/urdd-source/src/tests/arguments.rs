//! What arguments a xacro file takes, by its text and its package.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use crate::Files;
use crate::arguments::{ArgumentsError, XacroArgument, arguments, needed};
use crate::launched::{by_python, by_xml};
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
fn parameters_and_properties_that_are_arguments_name_files_too() {
    let folder = tempfile::tempdir().unwrap();
    let main = robot(
        "<xacro:include filename=\"load.xacro\"/><xacro:arg name=\"title\" default=\"arm\"/>\
         <xacro:arg name=\"type\" default=\"NONE\"/><xacro:arg name=\"dof\" default=\"7\"/>\
         <xacro:arg name=\"hand\" default=\"\"/><xacro:property name=\"joints\" value=\"$(arg dof)\"/>\
         <xacro:load kind=\"$(arg type)\" hand=\"$(arg hand)\" colour=\"$(arg type)\"/>\
         <xacro:paint colour=\"$(arg hand)\"/>",
    );
    let load = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\
        <xacro:macro name=\"load\" params=\"kind hand colour\">\
        <xacro:include filename=\"$(find arms)/kinds/${kind}/${joints}dof/${kind}.xacro\"/>\
        <xacro:if value=\"${hand}\"><xacro:include filename=\"$(find arms)/hands/${hand}.xacro\"/></xacro:if>\
        <xacro:include filename=\"$(find arms)/hands/${colour}.xacro\"/></xacro:macro></robot>";
    write(
        folder.path(),
        &[
            ("arms/package.xml", MANIFEST),
            ("arms/urdf/arm.urdf.xacro", &main),
            ("arms/urdf/load.xacro", load),
            ("arms/kinds/long/7dof/long.xacro", ""),
            ("arms/kinds/short/6dof/short.xacro", ""),
            ("arms/hands/two.xacro", ""),
        ],
    );
    let row = |name: &str, default: &str, values: &str, is_needed| {
        (name.to_owned(), Some(default.to_owned()), values.to_owned(), is_needed)
    };
    assert_eq!(
        found(folder.path()),
        [
            row("dof", "7", "", false),
            // What only a condition asks for, and what is given two arguments, is not known.
            row("hand", "", "", false),
            row("title", "arm", "arm", true),
            row("type", "NONE", "long", true),
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
    let found = |text: &str| {
        let all = by_python(text).filter(|one| !one.choices.is_empty());
        all.map(|one| (one.name, one.choices)).collect::<Vec<_>>()
    };
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
        &format!("DeclareLaunchArgument('a', description='{}', choices=['x'])", "d".repeat(4096)),
    ] {
        assert_eq!(found(text), [], "{text}");
    }
}

#[test]
fn launch_files_say_what_arguments_are() {
    let python = "DeclareLaunchArgument('a', default_value='x', description='y'), DeclareLaunchArgument('b', default_value=f('x'))";
    let values: Vec<_> = by_python(python).map(|one| (one.name, one.value)).collect();
    assert_eq!(values, [("a".to_owned(), Some("x".to_owned())), ("b".to_owned(), None)]);
    let xml = "<launch><arg name='a' default='x'/><arg name='b' default='$(env B)'/><arg name='c'/>\
        <param name='d' command='xacro arm.xacro e:=y f:=$(arg a)'/><include file='g'><arg name='h' value='z'/></include></launch>";
    let values: Vec<_> = by_xml(xml).into_iter().map(|one| (one.name, one.value)).collect();
    let one = |name: &str, value: &str| (name.to_owned(), Some(value.to_owned()));
    assert_eq!(values, [one("a", "x"), one("e", "y"), one("h", "z")]);
    assert!(by_xml("<launch").is_empty());
}

#[test]
fn what_conditions_ask_for_is_a_value() {
    let main = robot(
        "<xacro:arg name=\"hand\" default=\"false\"/><xacro:arg name=\"tool\" default=\"none\"/><xacro:property name=\"with\" value=\"$(arg sim)\"/>\
         <xacro:if value=\"$(arg hand)\"/><xacro:unless value=\"${not with}\"/><xacro:if value=\"${'$(arg tool)' == 'saw'}\"/>\
         <xacro:if value=\"${1 &lt; 2}\"/><xacro:if value=\"$(arg DEBUG)\"/><link name=\"$(arg other)\"/>",
    );
    let all = in_memory("arm.urdf.xacro", &[("arm.urdf.xacro", &main)]).unwrap();
    let found: Vec<_> =
        all.iter().map(|one| (one.name.as_str(), one.values.join(" "), one.is_needed)).collect();
    let text = |name, values: &str, is_needed| (name, values.to_owned(), is_needed);
    assert_eq!(
        found,
        [
            text("DEBUG", "true false", true),
            text("hand", "true false", false),
            text("other", "", true),
            text("sim", "true false", true),
            text("title", "arm", true),
            text("tool", "saw", false),
        ]
    );
}

/// The arguments of a file in memory.
fn in_memory(file: &str, files: &[(&str, &str)]) -> Result<Vec<XacroArgument>, ArgumentsError> {
    let files = files.iter().map(|(path, text)| ((*path).to_owned(), Arc::from(text.as_bytes())));
    let settings = Settings { files: Files::in_memory(files).unwrap(), ..Settings::default() };
    arguments(&Path::new("/").join(file), &settings)
}

/// The values that are found for the argument `v` of a file with this content.
fn values(content: &str, more: &[(&str, &str)]) -> Vec<String> {
    let main = format!("<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}</robot>");
    let own = [("arms/package.xml", MANIFEST), ("arms/urdf/a.xacro", &*main)];
    let found = in_memory("arms/urdf/a.xacro", &[&own, more].concat()).unwrap();
    found.into_iter().find(|one| one.name == "v").unwrap().values
}

#[test]
fn what_is_looked_at_is_bounded() {
    let use_of = |path: &str| format!("<a b=\"$(find arms)/config/{path}\"/>");
    let config = |names: &[String]| -> Vec<String> {
        names.iter().map(|name| format!("arms/config/{name}")).collect()
    };
    let files = |paths: &[String]| {
        values(
            &use_of("$(arg v).yaml"),
            &paths.iter().map(|path| (&**path, "")).collect::<Vec<_>>(),
        )
    };
    // At most 100 values, of the first 1000 names.
    let many: Vec<String> = (0..150).map(|at| format!("{at:03}.yaml")).collect();
    assert_eq!(files(&config(&many)).len(), 100);
    let mut many: Vec<String> = (0..1000).map(|at| format!("a{at:03}")).collect();
    many[999] = "z.yaml".to_owned();
    assert_eq!(files(&config(&many)), ["z"]);
    many.push("a999".to_owned());
    assert!(files(&config(&many)).is_empty());
    // Long defaults of other arguments are not put in.
    for (length, count) in [(99, 1), (100, 0)] {
        let folder = "d".repeat(length);
        let default = format!("<xacro:arg name=\"d\" default=\"{folder}\"/>");
        let path = format!("arms/config/{folder}/x.yaml");
        let found = values(&(default + &use_of("$(arg d)/$(arg v).yaml")), &[(&path, "")]);
        assert_eq!(found.len(), count, "{length}");
    }
    // Launch files: the first 100, and of each at most 1 MiB.
    let choices = "DeclareLaunchArgument('v', choices=['x'])";
    let launch = |number: usize, text: &str| {
        let names: Vec<String> = (0..number).map(|at| format!("arms/launch/{at:03}.py")).collect();
        let text_of = |at: usize| if at + 1 == number { text } else { "" };
        let files: Vec<_> =
            names.iter().enumerate().map(|(at, name)| (&**name, text_of(at))).collect();
        values("<a b=\"$(arg v)\"/>", &files).len()
    };
    assert_eq!([launch(100, choices), launch(101, choices)], [1, 0]);
    let padded = |length: usize| format!("{choices}{}", " ".repeat(length - choices.len()));
    assert_eq!([launch(1, &padded(1 << 20)), launch(1, &padded((1 << 20) + 1))], [1, 0]);
}

/// What is looked for, and made, for arguments is charged. Each of these is within the size of a file.
#[test]
fn what_grows_with_a_square_is_charged() {
    let file = |content: &str| {
        format!("<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\">{content}</robot>")
    };
    // A copy of the folder for each text.
    let folder = "f".repeat(4000);
    let texts = file(&"<a b=\"$(arg c)\"/>".repeat(70_000));
    // Each path of a text for each use in it.
    let paths = file(&format!("<a b=\"{}\"/>", "'$(arg c)'".repeat(1500)));
    // A copy of a text for each default that is put in.
    let defaults: String = (0..3000)
        .map(|at| format!("<xacro:arg name=\"x{at}\" default=\"{}\"/>", "d".repeat(99)))
        .collect();
    let others: String = (0..3000).map(|at| format!("$(arg x{at})")).collect();
    let defaults = file(&format!("{defaults}<a b=\"x/$(arg c){others}\"/>"));
    // A long path for each name of a folder.
    let long = file(&format!("<a b=\"names/$(arg c)/{}\"/>", "l".repeat(300_000)));
    let names: Vec<String> = (0..1000).map(|at| format!("{folder}/names/{at}")).collect();
    // A long name for each use of a property in the name of a file.
    let property = format!("<xacro:property name=\"p\" value=\"$(arg {})\"/>", "n".repeat(200_000));
    let uses = "${p}".repeat(100_000);
    let aliases = file(&format!("{property}<xacro:include filename=\"{uses}\"/>"));
    for text in [texts, paths, defaults, long, aliases] {
        let path = format!("{folder}/a.xacro");
        let names = names.iter().map(|name| (&**name, ""));
        let files: Vec<_> = [(&*path, &*text)].into_iter().chain(names).collect();
        let found = in_memory(&path, &files);
        assert!(matches!(found, Err(ArgumentsError::Account(_))), "{text:.100}: {found:?}");
    }
}

/// It is asked once a file cannot be expanded.
#[test]
fn a_file_that_is_nothing_by_default_is_needed() {
    let folder = tempfile::tempdir().unwrap();
    let declared =
        |name: &str, default: &str| format!("<xacro:arg name=\"{name}\" default=\"{default}\"/>");
    let main =
        declared("speeds_file", "") + &declared("prefix", "") + &declared("limits_yaml", "a.yaml");
    let file = folder.path().join("arm.xacro");
    fs::write(&file, robot(&main)).unwrap();
    let names = |settings: &Settings| -> Vec<String> {
        needed(&file, settings).into_iter().map(|one| one.name).collect()
    };
    // xacro knows no argument in an attribute of the root yet.
    assert_eq!(names(&Settings::default()), ["speeds_file", "title"]);
    let given = Settings::default().with_declared(&["speeds_file:=b.yaml".to_owned()]);
    assert_eq!(names(&given), ["title"]);
}
