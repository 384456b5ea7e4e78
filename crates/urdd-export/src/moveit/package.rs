//! The package: its description, how it is installed, a launch file, and what RViz shows.

use super::config::Config;
use super::controllers::{self, Controller};
use crate::Ros;
use crate::output::fill;
use crate::yaml::quoted;
use urdd_xml::writer::escaped;

const PACKAGE: &str = include_str!("package.xml.in");
const LAUNCH: &str = include_str!("demo.launch.py.in");
const RVIZ: &str = include_str!("moveit.rviz.in");

/// What every package needs where it is started; controllers need others.
const NEEDED: &[&str] = &[
    "controller_manager",
    "joint_state_broadcaster",
    "moveit_configs_utils",
    "moveit_kinematics",
    "moveit_planners",
    "moveit_ros_move_group",
    "moveit_ros_visualization",
    "moveit_simple_controller_manager",
    "robot_state_publisher",
    "rviz2",
    "tf2_ros",
    "xacro",
];

/// How the controller manager gets the URDF, as in the launch files of `moveit_configs_utils`.
fn manager(ros: Ros) -> &'static str {
    match ros {
        Ros::Humble => {
            "parameters=[moveit.robot_description, str(config / \"ros2_controllers.yaml\")],"
        }
        Ros::Jazzy => {
            "parameters=[str(config / \"ros2_controllers.yaml\")],
            remappings=[(\"/controller_manager/robot_description\", \"/robot_description\")],"
        }
    }
}

pub(super) fn files(config: &Config, controllers: &[Controller]) -> Vec<(String, String)> {
    let robot = &config.subject.urdf.name;
    let root = quoted(&config.subject.links[config.subject.tree.root]);
    let group = config.setup.groups.first().map_or("", |group| group.value.name.as_str());
    let package = config.package;
    let started: Vec<String> = controllers::names(controllers).map(quoted).collect();
    let mut needed = NEEDED.to_vec();
    needed.extend(controllers::packages(controllers, config.ros));
    needed.sort_unstable();
    needed.dedup();
    let needed = needed.iter().map(|name| format!("  <exec_depend>{name}</exec_depend>\n"));
    let description =
        [("PACKAGE", escaped(package)), ("ROBOT", escaped(robot)), ("NEEDED", needed.collect())];
    let launch = [
        ("PACKAGE", quoted(package)),
        ("ROBOT", quoted(robot)),
        ("URDF", quoted(&format!("config/{}.urdf", config.name))),
        ("SRDF", quoted(&format!("config/{}.srdf", config.name))),
        ("ROOT", root.clone()),
        ("CONTROLLERS", format!("[{}]", started.join(", "))),
        ("MANAGER", manager(config.ros).to_owned()),
    ];
    let rviz = [("GROUP", quoted(group)), ("ROOT", root)];
    vec![
        ("package.xml".to_owned(), fill(PACKAGE, &description)),
        ("CMakeLists.txt".to_owned(), cmake(config)),
        ("config/moveit.rviz".to_owned(), fill(RVIZ, &rviz)),
        ("launch/demo.launch.py".to_owned(), fill(LAUNCH, &launch)),
    ]
}

fn cmake(config: &Config) -> String {
    let mut text = format!(
        "cmake_minimum_required(VERSION 3.10.2)\nproject({})\nfind_package(ament_cmake REQUIRED)\n\nament_package()\n\n",
        config.package
    );
    let meshes = config.subject.options.mesh_folder.rsplit('/').next();
    for folder in ["launch", "config"].into_iter().chain(meshes) {
        // CMake's escapes in a quoted argument.
        let folder = folder.replace('\\', "\\\\").replace('"', "\\\"").replace('$', "\\$");
        text += &format!(
            "install(DIRECTORY \"{folder}\" DESTINATION share/${{PROJECT_NAME}} OPTIONAL)\n"
        );
    }
    text
}
