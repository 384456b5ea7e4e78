//! The package: its description, how it is installed, a launch file, and what RViz shows.

use super::super::element::Element;
use super::super::yaml::{Yaml, quoted as python};
use super::config::Config;
use super::controllers;

/// What the launch file starts.
const DEPENDENCIES: [&str; 12] = [
    "controller_manager",
    "gripper_controllers",
    "joint_state_broadcaster",
    "joint_trajectory_controller",
    "moveit_configs_utils",
    "moveit_kinematics",
    "moveit_planners",
    "moveit_ros_move_group",
    "moveit_ros_visualization",
    "moveit_simple_controller_manager",
    "robot_state_publisher",
    "tf2_ros",
];

/// Package, robot, its files, root link and controllers take the place of the words in capitals.
const LAUNCH: &str = include_str!("demo.launch.py.in");

pub(super) fn files(config: &Config) -> Vec<(String, String)> {
    vec![
        ("package.xml".to_owned(), package(config)),
        ("CMakeLists.txt".to_owned(), cmake(config)),
        ("config/moveit.rviz".to_owned(), rviz(config)),
        ("launch/demo.launch.py".to_owned(), launch(config)),
    ]
}

fn package(config: &Config) -> String {
    let text = |name: &'static str, text: &str| Element::new(name).containing(text);
    let robot = &config.subject.urdf.name;
    let mut package = Element::new("package").with("format", "3");
    package.push(text("name", &config.options.package));
    package.push(text("version", "0.1.0"));
    package.push(text("description", &format!("MoveIt 2 configuration of {robot}, made by urdd")));
    package.push(text("maintainer", "you").with("email", "you@example.com"));
    package.push(text("license", "TODO: the license of the robot's description"));
    package.push(text("buildtool_depend", "ament_cmake"));
    for dependency in DEPENDENCIES {
        package.push(text("exec_depend", dependency));
    }
    package.push(Element::new("export").holding(text("build_type", "ament_cmake")));
    package.document(&[])
}

fn cmake(config: &Config) -> String {
    let mut text = format!(
        "cmake_minimum_required(VERSION 3.10.2)\nproject({})\nfind_package(ament_cmake REQUIRED)\n\nament_package()\n\n",
        &config.options.package
    );
    let meshes = config.options.meshes.folder.rsplit('/').next();
    for folder in ["launch", "config"].into_iter().chain(meshes) {
        // CMake's escapes in a quoted argument.
        let folder = folder.replace('\\', "\\\\").replace('"', "\\\"").replace('$', "\\$");
        text += &format!(
            "install(DIRECTORY \"{folder}\" DESTINATION share/${{PROJECT_NAME}} OPTIONAL)\n"
        );
    }
    text
}

fn launch(config: &Config) -> String {
    let names = controllers::names(config);
    let names: Vec<String> = names.iter().map(|name| python(name)).collect();
    let root = &config.subject.links[config.subject.tree.root];
    let replaced = [
        ("PACKAGE", python(&config.options.package)),
        ("ROBOT", python(&config.subject.urdf.name)),
        ("URDF", python(&format!("config/{}.urdf", config.name))),
        ("SRDF", python(&format!("config/{}.srdf", config.name))),
        ("ROOT", python(root)),
        ("CONTROLLERS", format!("[{}]", names.join(", "))),
    ];
    let mut text = String::new();
    for line in LAUNCH.lines() {
        // A value may hold the words of others: each line has one.
        let word = replaced.iter().find(|(word, _)| line.ends_with(&format!("= {word}")));
        match word {
            Some((word, value)) => text += &line.replace(word, value),
            None => text += line,
        }
        text.push('\n');
    }
    text
}

fn rviz(config: &Config) -> String {
    let group = config.setup.groups.first();
    let group = group.map_or("", |group| group.value.name.as_str());
    let display = Yaml::map([
        ("Class", Yaml::plain("moveit_rviz_plugin/MotionPlanning")),
        ("Name", Yaml::plain("MotionPlanning")),
        ("Enabled", Yaml::plain("true")),
        ("Move Group Namespace", Yaml::text("")),
        ("Robot Description", Yaml::plain("robot_description")),
        ("Planning Scene Topic", Yaml::plain("monitored_planning_scene")),
        ("Planning Request", Yaml::map([("Planning Group", Yaml::text(group))])),
    ]);
    let grid = Yaml::map([
        ("Class", Yaml::plain("rviz_default_plugins/Grid")),
        ("Name", Yaml::plain("Grid")),
        ("Enabled", Yaml::plain("true")),
    ]);
    let root = &config.subject.links[config.subject.tree.root];
    let manager = Yaml::map([
        ("Displays", Yaml::List(vec![grid, display])),
        ("Global Options", Yaml::map([("Fixed Frame", Yaml::text(root))])),
        (
            "Tools",
            Yaml::List(vec![Yaml::map([(
                "Class",
                Yaml::plain("rviz_default_plugins/MoveCamera"),
            )])]),
        ),
    ]);
    Yaml::map([("Visualization Manager", manager)]).document(&[])
}
