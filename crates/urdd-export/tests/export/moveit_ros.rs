//! MoveIt's package by the distribution of ROS 2, and by the interfaces of the source's `<ros2_control>`. The words are those
//! of the branches `humble` and `jazzy` of moveit2 and ros2_controllers.

use std::collections::BTreeMap;

use crate::made::export;
use serde_json::{Value, json};
use testkit::robots::made_of;
use testkit::urdfs::mobile;
use urdd_export::{Choices, Format, Ros, Setup};
use urdd_robot::Robot;

/// The files of a package that are texts, and the notes.
fn package(urdf: &str, ros: Option<Ros>, limits: &str) -> (BTreeMap<String, String>, Vec<String>) {
    let (_folder, path) = made_of(urdf);
    let robot = Robot::open(path).expect("a robot");
    let guess = Setup::guess(&robot).expect("guesses").to_toml(&robot).expect("text");
    let text = guess.replace("[limits]", &format!("[limits]\n{limits}"));
    let setup = Some(Setup::from_toml(&text, "x", &robot).expect("read"));
    let choices = Choices { ros, setup, ..Choices::default() };
    let made = export(&robot, Format::Moveit, &choices).expect("an export");
    let texts = made.files.into_iter().filter(|(path, _)| !path.starts_with("meshes/"));
    let texts = texts.map(|(path, bytes)| (path, String::from_utf8(bytes).expect("text")));
    (texts.collect(), made.notes.iter().map(ToString::to_string).collect())
}

fn yaml(text: &str) -> Value {
    serde_yaml::from_str(text).expect("YAML")
}

/// A robot with this `<ros2_control>`: of each joint its command and state interfaces.
fn with_hardware(joints: &[(&str, &[&str], &[&str])]) -> String {
    let mut text = "<ros2_control name=\"GazeboSystem\" type=\"system\"><hardware>\
        <plugin>gazebo_ros2_control/GazeboSystem</plugin></hardware>"
        .to_owned();
    for (name, commands, states) in joints {
        text += &format!("<joint name=\"{name}\">");
        for (kind, names) in [("command", commands), ("state", states)] {
            text.extend(names.iter().map(|of| format!("<{kind}_interface name=\"{of}\"/>")));
        }
        text += "</joint>";
    }
    mobile().replace("</robot>", &format!("{text}</ros2_control></robot>"))
}

#[test]
fn each_distribution_has_its_own_words() {
    let gripper = |files: &BTreeMap<String, String>| {
        let moveit = yaml(&files["config/moveit_controllers.yaml"]);
        let ros2 = yaml(&files["config/ros2_controllers.yaml"]);
        let manager = &ros2["controller_manager"]["ros__parameters"];
        let kind = &moveit["moveit_simple_controller_manager"]["hand_controller"]["type"];
        [kind.clone(), manager["hand_controller"]["type"].clone()]
    };
    // A hand of one joint: the second finger follows the first.
    let urdf =
        mobile().replace("<axis xyz=\"0 -1 0\"/>", "<axis xyz=\"0 -1 0\"/><mimic joint=\"f1\"/>");
    let (jazzy, _) = package(&urdf, None, "");
    assert_eq!(jazzy, package(&urdf, Some(Ros::Jazzy), "").0);
    let planning = yaml(&jazzy["config/ompl_planning.yaml"]);
    assert_eq!(planning["planning_plugins"], json!(["ompl_interface/OMPLPlanner"]));
    assert!(planning["request_adapters"].is_array() && planning["response_adapters"].is_array());
    assert_eq!(
        gripper(&jazzy),
        ["ParallelGripperCommand", "parallel_gripper_action_controller/GripperActionController"]
    );
    assert!(jazzy["package.xml"].contains("<exec_depend>parallel_gripper_controller<"));
    assert!(!jazzy["launch/demo.launch.py"].contains("parameters=[moveit.robot_description, str"));

    let (humble, _) = package(&urdf, Some(Ros::Humble), "");
    let planning = yaml(&humble["config/ompl_planning.yaml"]);
    assert_eq!(planning["planning_plugin"], "ompl_interface/OMPLPlanner");
    let adapters = planning["request_adapters"].as_str().expect("one text");
    let all = adapters.split_whitespace().collect::<Vec<_>>();
    assert!(all.len() == 6 && all.iter().all(|one| one.starts_with("default_planner_request_")));
    assert!(planning.get("planning_plugins").is_none(), "{planning}");
    assert_eq!(
        gripper(&humble),
        ["GripperCommand", "position_controllers/GripperActionController"]
    );
    assert!(humble["package.xml"].contains("<exec_depend>gripper_controllers<"));
    assert!(humble["launch/demo.launch.py"].contains("parameters=[moveit.robot_description, str"));
}

/// Wheels take velocities, whether the source says so or they are only found to be wheels.
#[test]
fn controllers_follow_the_interfaces_of_the_source() {
    let all: &[&str] = &["position", "velocity"];
    let arm = ["j1", "j2", "j3", "j4", "f1", "f2"].map(|name| (name, all, all));
    let wheels: [(&str, &[&str], &[&str]); 2] =
        [("w1", &["velocity"], all), ("w2", &["velocity"], all)];
    let source = with_hardware(&[&wheels[..], &arm].concat());
    for (urdf, has_hardware) in [(source.as_str(), true), (mobile().as_str(), false)] {
        let (files, notes) = package(urdf, None, "acceleration = 2.0");
        let ros2 = yaml(&files["config/ros2_controllers.yaml"]);
        let wheels = &ros2["wheels_velocity_controller"]["ros__parameters"];
        assert_eq!(*wheels, json!({"joints": ["w1", "w2"]}));
        let manager = &ros2["controller_manager"]["ros__parameters"];
        assert_eq!(
            manager["wheels_velocity_controller"]["type"],
            "velocity_controllers/JointGroupVelocityController"
        );
        assert_eq!(
            ros2["arm_controller"]["ros__parameters"]["state_interfaces"],
            json!(["position", "velocity"])
        );
        let moveit = yaml(&files["config/moveit_controllers.yaml"]);
        assert_eq!(
            moveit["moveit_simple_controller_manager"]["controller_names"],
            json!(["arm_controller", "hand_controller"])
        );
        assert!(files["package.xml"].contains("<exec_depend>velocity_controllers<"));
        assert!(files["launch/demo.launch.py"].contains("\"wheels_velocity_controller\""));
        // One hardware, ours, with the interfaces that the controllers take.
        let text = &files["config/m.urdf"];
        let urdf = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
        let plugins = urdf.descendants().filter(|node| node.has_tag_name("plugin"));
        let plugins: Vec<_> = plugins.filter_map(|node| node.text()).collect();
        assert_eq!(plugins, ["mock_components/GenericSystem"]);
        let hardware = urdf.descendants().find(|node| node.has_tag_name("ros2_control"));
        let joints = hardware.expect("hardware").children().filter(|of| of.has_tag_name("joint"));
        let commands = joints.map(|joint| {
            let all = joint.children().filter(|of| of.has_tag_name("command_interface"));
            let all: Vec<&str> = all.filter_map(|of| of.attribute("name")).collect();
            (joint.attribute("name").expect("a name"), all.join(" "))
        });
        let arm = if has_hardware { "position velocity" } else { "position" };
        let commands: BTreeMap<&str, String> = commands.collect();
        assert_eq!((commands["w1"].as_str(), commands["j1"].as_str()), ("velocity", arm));
        let said = |words: &str| notes.iter().any(|note| note.contains(words));
        assert!(said("group `wheels`: MoveIt sends it no trajectories"), "{notes:?}");
        assert_eq!(said("is in its place"), has_hardware, "{notes:?}");
        assert!(!said("without a limit"), "{notes:?}");
    }
}

/// Programs read the hardware of the robot itself: in a link, an element of this name is one like others.
#[test]
fn hardware_in_a_link_is_not_replaced() {
    let inside = "<ros2_control name=\"inside\" type=\"system\"/>";
    let urdf = mobile()
        .replace("<link name=\"chassis\"/>", &format!("<link name=\"chassis\">{inside}</link>"));
    let (files, notes) = package(&urdf, None, "");
    let text = &files["config/m.urdf"];
    let urdf = urdd_xml::parse(text, urdd_xml::Kind::Other).expect("well-formed");
    let hardware = urdf.descendants().filter(|node| node.has_tag_name("ros2_control"));
    let hardware = hardware.map(|node| {
        let parent = node.parent_element().expect("a parent");
        (parent.tag_name().name(), node.attribute("name").expect("a name"))
    });
    assert_eq!(hardware.collect::<Vec<_>>(), [("link", "inside"), ("robot", "mock_hardware")]);
    assert!(!notes.iter().any(|note| note.contains("is in its place")), "{notes:?}");
}

#[test]
fn joints_that_take_no_position_get_no_trajectories() {
    let all: &[&str] = &["position"];
    let urdf = with_hardware(&[
        ("j1", &["effort"], all),
        ("j2", &["position"], all),
        ("j3", &[], all),
        ("f1", &["effort"], all),
        ("f2", &["effort"], all),
    ]);
    let (files, notes) = package(&urdf, None, "");
    let ros2 = yaml(&files["config/ros2_controllers.yaml"]);
    // A joint that the hardware does not name takes positions.
    let arm = &ros2["arm_controller"]["ros__parameters"];
    assert_eq!(arm["joints"], json!(["j2", "j4"]));
    assert_eq!(arm["state_interfaces"], json!(["position"]));
    assert_eq!(ros2["arm_effort_controller"]["ros__parameters"], json!({"joints": ["j1"]}));
    assert_eq!(
        ros2["controller_manager"]["ros__parameters"]["hand_effort_controller"]["type"],
        "effort_controllers/JointGroupEffortController"
    );
    assert!(ros2.get("hand_controller").is_none(), "{ros2}");
    for group in ["arm", "hand", "wheels"] {
        let words = format!("group `{group}`: MoveIt sends it no trajectories");
        assert!(notes.iter().any(|note| note.contains(&words)), "{notes:?}");
    }
}

/// Where MoveIt sends nothing, there is no empty list: ROS cannot tell of what type it is.
#[test]
fn a_robot_of_wheels_alone_has_no_list_of_controllers() {
    let wheels = ["w1", "w2"].map(|name| (name, &["velocity"][..], &["velocity"][..]));
    let arm = ["j1", "j2", "j3", "j4", "f1", "f2"].map(|name| (name, &["effort"][..], &[][..]));
    let (files, _) = package(&with_hardware(&[&wheels[..], &arm].concat()), None, "");
    let moveit = yaml(&files["config/moveit_controllers.yaml"]);
    assert!(moveit.get("moveit_simple_controller_manager").is_none(), "{moveit}");
    assert!(moveit["moveit_controller_manager"].is_string());
}

/// What a MoveIt does without limits of acceleration is in its `time_optimal_trajectory_generation.cpp`.
#[test]
fn missing_limits_of_acceleration_are_said() {
    for (ros, words) in [
        (Ros::Humble, "MoveIt of Humble takes 1"),
        (Ros::Jazzy, "MoveIt of Jazzy then fails every plan"),
    ] {
        let (_, notes) = package(&mobile(), Some(ros), "");
        let unlimited: Vec<_> =
            notes.iter().filter(|note| note.contains("without a limit")).collect();
        let [note] = unlimited[..] else { panic!("{notes:?}") };
        assert!(note.starts_with("joints without a limit of acceleration: `j1`"), "{note}");
        assert!(note.contains(words) && note.contains("`[limits]`"), "{note}");
        let (_, notes) = package(&mobile(), Some(ros), "acceleration = 2.0");
        assert!(!notes.iter().any(|note| note.contains("without a limit")), "{notes:?}");
    }
}
