//! MoveIt's package, read by readers of its formats. `tests/figures/exports/moveit.py` has MoveIt's
//! own readers read them, `whole.py` compares one with MoveIt's.

use std::collections::BTreeMap;

use crate::made::export;
use serde_json::{Value, json};
use urdd_export::{Choices, Export, ExportError, Format, Ros, Setup};
use urdd_robot::Robot;

use testkit::robots::{made, made_of, our_robots};

/// An arm of three joints with a gripper of two fingers, the second of which follows the first.
const URDF: &str = r#"<robot name="r"><link name="base"/><link name="l1"/><link name="l2"/><link name="l3"/><link name="palm"/>
<link name="f1"/><link name="f2"/>
<joint name="a" type="revolute"><parent link="base"/><child link="l1"/><axis xyz="0 0 1"/><origin xyz="0 0 0.3"/>
<limit lower="-1" upper="1" effort="5" velocity="2" acceleration="4"/></joint>
<joint name="b" type="revolute"><parent link="l1"/><child link="l2"/><axis xyz="0 1 0"/><origin xyz="0 0 0.3"/>
<limit lower="-1" upper="1" effort="5" velocity="2"/></joint>
<joint name="c" type="revolute"><parent link="l2"/><child link="l3"/><axis xyz="0 1 0"/><origin xyz="0 0 0.3"/>
<limit lower="-1" upper="1" effort="5" velocity="0"/></joint>
<joint name="d" type="fixed"><parent link="l3"/><child link="palm"/><origin xyz="0 0 0.1"/></joint>
<joint name="g" type="prismatic"><parent link="palm"/><child link="f1"/><axis xyz="0 1 0"/><origin xyz="0 0 0.05"/>
<limit lower="0" upper="0.04" effort="5" velocity="0.2"/></joint>
<joint name="h" type="prismatic"><parent link="palm"/><child link="f2"/><axis xyz="0 -1 0"/><origin xyz="0 0 0.05"/>
<limit lower="0" upper="0.04" effort="5" velocity="0.2"/><mimic joint="g"/></joint></robot>"#;

fn files(made: &Export) -> BTreeMap<&str, &str> {
    let texts = made.files.iter().filter(|(path, _)| !path.starts_with("meshes/"));
    texts.map(|(path, bytes)| (path.as_str(), std::str::from_utf8(bytes).expect("text"))).collect()
}

fn yaml(text: &str) -> Value {
    serde_yaml::from_str(text).expect("YAML")
}

#[test]
fn a_package_has_what_moveit_needs() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let guess = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
    let setup = guess.replace("[limits]", "[limits]\njerk = 100.0");
    assert_ne!(setup, guess);
    let setup = Setup::from_toml(&setup, "x", &robot).expect("read");
    let options =
        Choices { package: Some("r_config".to_owned()), setup: Some(setup), ..Choices::default() };
    let made = export(&robot, Format::Moveit, &options).expect("an export");
    assert_eq!(made.path.as_deref(), Some("config/r.srdf"));
    let srdf = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let elements: Vec<String> = srdf
        .root_element()
        .descendants()
        .filter(|node| node.is_element() && !node.has_tag_name("robot"))
        .map(|node| {
            let attributes = node.attributes().map(|of| format!(" {}={}", of.name(), of.value()));
            node.tag_name().name().to_owned() + &attributes.collect::<String>()
        })
        .collect();
    assert_eq!(
        elements,
        [
            "group name=arm",
            "chain base_link=base tip_link=l3",
            "group name=hand",
            "joint name=g",
            "end_effector name=hand parent_link=l3 group=hand parent_group=arm",
            "virtual_joint name=virtual_joint type=fixed parent_frame=world child_link=base",
            "passive_joint name=h",
        ]
    );
    let files = files(&made);
    let limit = |velocity: f64, acceleration: f64| {
        json!({
            "has_velocity_limits": velocity > 0.0, "max_velocity": velocity,
            "has_acceleration_limits": acceleration > 0.0, "max_acceleration": acceleration,
            "has_jerk_limits": true, "max_jerk": 100.0,
        })
    };
    let limits = yaml(files["config/joint_limits.yaml"]);
    let expected = json!({"a": limit(2.0, 4.0), "b": limit(2.0, 0.0), "c": limit(0.0, 0.0), "g": limit(0.2, 0.0)});
    assert_eq!(limits["joint_limits"], expected);
    let kinematics = yaml(files["config/kinematics.yaml"]);
    assert_eq!(kinematics.as_object().expect("a map").keys().collect::<Vec<_>>(), ["arm"]);
    let ompl = yaml(files["config/ompl_planning.yaml"]);
    for group in ["arm", "hand"] {
        for planner in ompl[group]["planner_configs"].as_array().expect("planners") {
            assert!(ompl["planner_configs"][planner.as_str().expect("a name")]["type"].is_string());
        }
    }
    // Both sides name the same controllers and joints.
    let moveit = &yaml(files["config/moveit_controllers.yaml"])["moveit_simple_controller_manager"];
    let ros2 = yaml(files["config/ros2_controllers.yaml"]);
    assert_eq!(moveit["controller_names"], json!(["arm_controller", "hand_controller"]));
    assert_eq!(moveit["arm_controller"]["joints"], json!(["a", "b", "c"]));
    assert_eq!(
        moveit["arm_controller"]["joints"],
        ros2["arm_controller"]["ros__parameters"]["joints"]
    );
    assert_eq!(moveit["hand_controller"]["type"], "ParallelGripperCommand");
    assert_eq!(ros2["hand_controller"]["ros__parameters"]["joint"], "g");
    for name in ["arm_controller", "hand_controller", "joint_state_broadcaster"] {
        assert!(ros2["controller_manager"]["ros__parameters"][name]["type"].is_string());
    }
    // The package is named the same everywhere, and the launch file starts what there is.
    let package =
        urdd_xml::parse(files["package.xml"], urdd_xml::Kind::Other).expect("well-formed");
    let name = package.descendants().find(|node| node.has_tag_name("name"));
    assert_eq!(name.and_then(|node| node.text()), Some("r_config"));
    assert!(files["CMakeLists.txt"].contains("project(r_config)\n"));
    let launch = files["launch/demo.launch.py"];
    for line in [
        "package = \"r_config\"",
        "robot = \"r\"",
        "urdf = \"config/r.urdf\"",
        "srdf = \"config/r.srdf\"",
        "root_link = \"base\"",
        "controllers = [\"arm_controller\", \"hand_controller\"]",
    ] {
        assert!(launch.lines().any(|found| found == line), "{line}\n{launch}");
    }
    let urdf = urdd_xml::parse(files["config/r.urdf"], urdd_xml::Kind::Other).expect("well-formed");
    let hardware =
        urdf.descendants().find(|node| node.has_tag_name("ros2_control")).expect("hardware");
    let driven = hardware.children().filter(|node| node.has_tag_name("joint"));
    assert_eq!(
        driven.filter_map(|node| node.attribute("name")).collect::<Vec<_>>(),
        ["a", "b", "c", "g"]
    );
}

/// Without a file, groups are guessed, and that is said.
#[test]
fn guesses_are_said() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Moveit, &Choices::default()).expect("an export");
    let notes: Vec<String> = made.notes.iter().map(ToString::to_string).collect();
    assert!(notes.iter().any(|note| note.contains("are guessed: `urdd export init`")), "{notes:?}");
}

/// Names that a person writes come out of the SRDF as they went in, or the export is refused and names them.
#[test]
fn names_of_groups_come_out_as_they_went_in() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    for (name, is_held) in [
        ("a-->\"/><evil a='", true),
        ("a: b #\u{202e}", true),
        ("{{x}}{%{#", true),
        ("a\tb", false),
        ("--ros-args", false),
        ("$$", false),
        ("\u{1b}[2J", false),
        ("\u{fffe}", false),
        ("${x}", false),
        ("", false),
    ] {
        let escaped: String = name.chars().map(|c| format!("\\U{:08X}", u32::from(c))).collect();
        for what in ["group", "end effector"] {
            let [group, end] =
                if what == "group" { [escaped.as_str(), "e"] } else { ["g", escaped.as_str()] };
            let text = format!(
                "robot = \"r\"\n[[group]]\nname = \"{group}\"\njoints = [\"a\"]\n\
                 [[end_effector]]\nname = \"{end}\"\ngroup = \"{group}\"\nparent_link = \"l3\"\n"
            );
            let options = Choices {
                setup: Some(Setup::from_toml(&text, "x", &robot).expect("read")),
                ..Choices::default()
            };
            match export(&robot, Format::Moveit, &options) {
                Ok(made) => {
                    assert!(is_held, "{name:?}");
                    let srdf =
                        urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
                    let tag = if what == "group" { "group" } else { "end_effector" };
                    let found = srdf.descendants().find(|node| node.has_tag_name(tag)).expect("it");
                    assert_eq!(found.attribute("name"), Some(name));
                    for (path, text) in files(&made) {
                        if path.ends_with(".yaml") || path.ends_with(".rviz") {
                            yaml(text);
                        }
                    }
                }
                Err(ExportError::Name { name: said, what: of, .. }) => {
                    assert!(!is_held && said == name && of == what, "{said:?} {of}");
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
}

/// Groups of groups, each named twice: as many paths as there are grains of sand, and as few groups as there are.
#[test]
fn groups_of_groups_are_visited_once() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    let mut text = String::from("robot = \"r\"\n");
    for k in 0..60 {
        let next = k + 1;
        text += &format!("[[group]]\nname = \"g{k}\"\ngroups = [\"g{next}\", \"g{next}\"]\n");
    }
    text += "[[group]]\nname = \"g60\"\njoints = [\"a\"]\n";
    let options = Choices {
        setup: Some(Setup::from_toml(&text, "x", &robot).expect("read")),
        ..Choices::default()
    };
    let made = export(&robot, Format::Moveit, &options).expect("an export");
    let controllers = yaml(files(&made)["config/moveit_controllers.yaml"]);
    let manager = &controllers["moveit_simple_controller_manager"];
    assert_eq!(manager["g0_controller"]["joints"], json!(["a"]));
}

/// The library says so too: a package's name is written into CMake and XML as it is, and places are those of a robot.
#[test]
fn what_does_not_belong_to_the_robot_is_refused() {
    let (_folder, path) = made_of(URDF);
    let robot = Robot::open(path).expect("a robot");
    for package in ["a)\nmessage(x", "../x", "A", ""] {
        let options = Choices { package: Some(package.to_owned()), ..Choices::default() };
        let error = export(&robot, Format::Moveit, &options).expect_err(package);
        assert!(matches!(error, ExportError::Package(_)), "{error}");
    }
    let robots = our_robots();
    let (_, urdf) = robots.iter().find(|(name, _)| name == "quadruped").expect("a robot");
    let (_other_folder, other) = made(urdf);
    let other = Robot::open(other).expect("a robot");
    let options =
        Choices { setup: Some(Setup::guess(&other).expect("guesses")), ..Choices::default() };
    for format in ["drake", "mjcf", "curobo", "moveit", "sdf"] {
        let format: Format = format.parse().unwrap();
        let error = export(&robot, format, &options).expect_err("another robot's");
        assert!(matches!(error, ExportError::OtherSetup { .. }), "{error}");
    }
}

/// In a file that names what is ours beside what is the robot's, the robot's name is left to it, or refused.
#[test]
fn names_of_our_own_are_not_the_robots() {
    let (_folder, path) = made_of(&URDF.replace("name=\"a\"", "name=\"virtual_joint\""));
    let robot = Robot::open(path).expect("a robot");
    let made = export(&robot, Format::Moveit, &Choices::default()).expect("an export");
    let srdf = urdd_xml::parse(&made.text, urdd_xml::Kind::Other).expect("well-formed");
    let ours = srdf.descendants().find(|node| node.has_tag_name("virtual_joint"));
    assert_eq!(ours.and_then(|node| node.attribute("name")), Some("virtual_joint_2"));
    for ros in Ros::ALL {
        let setup = |group: &str| {
            let text = format!(
                "robot = \"r\"\n[[group]]\nname = \"{group}\"\njoints = [\"virtual_joint\"]\n"
            );
            let setup = Setup::from_toml(&text, "x", &robot).expect("read");
            Choices { setup: Some(setup), ros: Some(*ros), ..Choices::default() }
        };
        let made = export(&robot, Format::Moveit, &setup("arm")).expect("an export");
        let planning = yaml(files(&made)["config/ompl_planning.yaml"]);
        for (key, value) in planning.as_object().expect("a map") {
            let is_group = value.get("default_planner_config").is_some();
            assert_eq!(is_group, key == "arm");
            if !is_group {
                let error = export(&robot, Format::Moveit, &setup(key)).expect_err(key);
                assert!(matches!(error, ExportError::Name { what: "group", .. }), "{error}");
            }
        }
    }
}
