//! A configuration package of MoveIt 2: groups, limits, solvers, planners, controllers, a launch file, and our URDF.
//!
//! The forms are those of MoveIt's own packages and of its Setup Assistant. The text of the export is the SRDF: groups, states,
//! end effectors, the virtual joint, passive joints, and pairs.

mod config;
mod controllers;

use crate::names::{ANOTHER, check_names, check_package};
use crate::output::fill;
use crate::yaml::{head, quoted};
use crate::{Export, ExportError, Members, Note, Ros, Subject, Taken, Yaml, srdf, urdf, xacro};
use config::Config;
use controllers::Controller;
use urdd_srdf::write;
use urdd_xml::number::number;
use urdd_xml::writer::{Element, escaped};

const REPLACED: &str = "the hardware of the source's `<ros2_control>` is not in the package: `mock_components/GenericSystem` is in its place, with the same command interfaces; to drive the robot, put the source's into the URDF of `config`";

pub(super) fn export(subject: &Subject) -> Result<Export, ExportError> {
    let package = subject.options.package.as_deref().unwrap_or_default();
    check_package(package)?;
    let mut notes = Vec::new();
    let setup = subject.setup(&mut notes)?;
    let config = Config::new(subject, package, &setup)?;
    let shapes = subject.shapes_by_link()?;
    let (mut robot, meshes) = urdf::robot(subject, shapes, &mut notes)?;
    robot.push(mock_hardware(&config));
    if config.hardware.is_of_source {
        notes.push(Note::Robot(REPLACED));
    }
    let controllers = controllers::controllers(&config);
    notes.extend(controllers::notes(&config, &controllers));
    let text = srdf(&config, &mut notes)?;
    let what = format!("Collision geometry: {}.", subject.shapes);
    let name = &config.name;
    let robot = robot.document_with(&subject.comments(what, &notes)?, xacro::text);
    let mut files = vec![(format!("config/{name}.urdf"), robot)];
    files.extend(planning_files(&config)?);
    files.extend(controllers::files(&config, &controllers)?);
    files.extend(package_files(&config, &controllers));
    let mut files: Vec<(String, Vec<u8>)> =
        files.into_iter().map(|(path, text)| (path, text.into_bytes())).collect();
    // Meshes are named by package: the folder of the package is where the export is.
    let prefix = format!("package://{package}/");
    files.extend(meshes.into_iter().map(|(path, bytes)| {
        let inside = path.strip_prefix(&prefix).map(str::to_owned);
        (inside.unwrap_or(path), bytes)
    }));
    files.sort();
    Ok(Export { path: Some(format!("config/{name}.srdf")), ..Export::of(text, files, notes) })
}

/// Simulated hardware that does what it is told, for the launch file. A joint that takes velocities tells them, and stays
/// where it is: `calculate_dynamics` takes joints for others whose names have theirs in them.
fn mock_hardware(config: &Config) -> Element {
    let plugin = Element::text("plugin", "mock_components/GenericSystem");
    let mut hardware = Element::new("ros2_control")
        .with("name", "mock_hardware")
        .with("type", "system")
        .holding(Element::new("hardware").holding(plugin));
    let configuration = config.configurations.first();
    let configuration = configuration.map_or(&config.default, |named| &named.configuration);
    for joint in config.controlled().into_iter().flat_map(|(_, joints)| joints) {
        let mut element = Element::new("joint").with("name", config.joint(joint));
        for command in config.hardware.commands(joint) {
            element.push(Element::new("command_interface").with("name", command.word()));
        }
        let initial = number(config.position(configuration, joint));
        let initial = Element::text("param", &initial).with("name", "initial_value");
        element.push(Element::new("state_interface").with("name", "position").holding(initial));
        element.push(Element::new("state_interface").with("name", "velocity"));
        hardware.push(element);
    }
    hardware
}

const NO_GROUPS: &str =
    "MoveIt plans for groups, and there are none: write some in the file of `urdd export init`";

fn srdf(config: &Config, notes: &mut Vec<Note>) -> Result<String, ExportError> {
    let subject = config.subject;
    let groups = &config.setup.groups;
    let ends = &config.setup.end_effectors;
    let names: [(&str, Vec<&str>); 3] = [
        ("group", groups.iter().map(|group| group.value.name.as_str()).collect()),
        ("end effector", ends.iter().map(|end| end.value.name.as_str()).collect()),
        ("configuration", config.configurations.iter().map(|it| it.name.as_str()).collect()),
    ];
    for (what, names) in names {
        check_names(subject.format, what, names.into_iter(), ANOTHER)?;
    }
    if groups.is_empty() {
        notes.push(Note::Robot(NO_GROUPS));
    }
    let mut robot = Element::new("robot").with("name", subject.urdf.name.as_str());
    for group in groups {
        robot.push(self::group(config, &group.value.name, &group.value.members));
    }
    states(config, &mut robot);
    for end in ends {
        let end = &end.value;
        let parent = end.parent_group.map(|group| groups[group].value.name.as_str());
        robot.push(
            Element::new("end_effector")
                .with("name", end.name.as_str())
                .with("parent_link", subject.links[end.parent_link].as_str())
                .with("group", groups[end.group].value.name.as_str())
                .with_some("parent_group", parent),
        );
    }
    let root = subject.tree.root;
    if !subject.is_world(root) {
        let kind = if config.setup.floating.value { "floating" } else { "fixed" };
        let mut taken = Taken::new(subject.view.joints.iter().map(|joint| &joint.name));
        robot.push(
            Element::new("virtual_joint")
                .with("name", taken.free("virtual_joint".to_owned()))
                .with("type", kind)
                .with("parent_frame", "world")
                .with("child_link", subject.links[root].as_str()),
        );
    }
    for joint in passive(config) {
        robot.push(Element::new("passive_joint").with("name", config.joint(joint)));
    }
    srdf::push_pairs(subject, &mut robot);
    notes.extend(subject.notes());
    Ok(robot.document(&subject.comments(srdf::basis(subject)?, notes)?))
}

fn group(config: &Config, name: &str, members: &Members) -> Element {
    let mut group = write::group(name);
    match members {
        Members::Chain { base, tip } => {
            let [base, tip] = [base, tip].map(|link| config.subject.links[*link].as_str());
            group.push(Element::new("chain").with("base_link", base).with("tip_link", tip));
        }
        Members::Joints(joints) => {
            for joint in joints {
                group.push(write::joint(config.joint(*joint)));
            }
        }
        Members::Groups(groups) => {
            for other in groups {
                let name = config.setup.groups[*other].value.name.as_str();
                group.push(write::group(name));
            }
        }
    }
    group
}

/// A state of each group for each named configuration that sets one of its joints.
fn states(config: &Config, robot: &mut Element) {
    for (group, joints) in config.setup.groups.iter().zip(&config.joints) {
        for named in config.configurations {
            let is_set = |joint: &&usize| {
                let name = config.joint(**joint);
                named.positions.iter().any(|set| set.dof_name == name)
            };
            if !joints.iter().any(|joint| is_set(&joint)) {
                continue;
            }
            let driven = joints.iter().filter(|joint| config.subject.is_driven(**joint));
            let values = driven.map(|joint| {
                (config.joint(*joint), number(config.position(&named.configuration, *joint)))
            });
            robot.push(write::state(named.name.as_str(), &group.value.name, values));
        }
    }
}

/// The joints that follow others, and those of passive groups.
fn passive(config: &Config) -> Vec<usize> {
    let subject = config.subject;
    let joints = 0..subject.view.joints.len();
    let mut passive: Vec<usize> = joints
        .filter(|joint| subject.view.joints[*joint].num_dofs() > 0 && !subject.moves(*joint))
        .collect();
    for (group, joints) in config.setup.groups.iter().zip(&config.joints) {
        if group.value.passive {
            passive.extend(joints);
        }
    }
    passive.sort_unstable();
    passive.dedup();
    passive
}

/// Plugins and adapters, by the names that a distribution's MoveIt has for them.
fn pipeline(ros: Ros) -> &'static str {
    match ros {
        Ros::Humble => include_str!("ompl_humble.yaml.in"),
        Ros::Jazzy => include_str!("ompl_jazzy.yaml.in"),
    }
}

/// Planners. Their parameters are OMPL's defaults.
const OMPL: &str = include_str!("ompl_planning.yaml.in");

/// The planners of a group, the default one first.
const PLANNERS: [&str; 5] = [
    "RRTConnectkConfigDefault",
    "RRTstarkConfigDefault",
    "BiTRRTkConfigDefault",
    "PRMkConfigDefault",
    "PRMstarkConfigDefault",
];

fn planning_files(config: &Config) -> Result<Vec<(String, String)>, ExportError> {
    let limits = config.comments("Limits of velocity are the URDF's, of acceleration and jerk the URDF's or those of `[limits]`: rad/s, m/s and so on.")?;
    let kinematics =
        config.comments("Solvers of inverse kinematics, for each group that is a chain.")?;
    let planning = config.comments("Planners, with OMPL's default parameters.")?;
    Ok(vec![
        ("config/joint_limits.yaml".to_owned(), self::limits(config).document(&limits)),
        ("config/kinematics.yaml".to_owned(), self::kinematics(config).document(&kinematics)),
        (
            "config/ompl_planning.yaml".to_owned(),
            head(&planning) + pipeline(config.ros) + OMPL + &planners(config),
        ),
    ])
}

fn limits(config: &Config) -> Yaml {
    let subject = config.subject;
    let joints = (0..subject.view.joints.len()).filter(|joint| subject.is_driven(*joint));
    let limits = joints.map(|joint| {
        let [velocity, acceleration, jerk] = config.limits(joint);
        let mut entries = Vec::new();
        for (has, most, value) in [
            ("has_velocity_limits", "max_velocity", velocity),
            ("has_acceleration_limits", "max_acceleration", acceleration),
            ("has_jerk_limits", "max_jerk", jerk),
        ] {
            entries.push((has.to_owned(), Yaml::Plain(value.is_some().to_string())));
            entries.push((most.to_owned(), Yaml::number(value.unwrap_or(0.0))));
        }
        (config.joint(joint), Yaml::Map(entries))
    });
    Yaml::map([
        ("default_velocity_scaling_factor", Yaml::number(0.1)),
        ("default_acceleration_scaling_factor", Yaml::number(0.1)),
        ("joint_limits", Yaml::named(limits)),
    ])
}

fn kinematics(config: &Config) -> Yaml {
    let solver = || {
        Yaml::map([
            ("kinematics_solver", Yaml::plain("kdl_kinematics_plugin/KDLKinematicsPlugin")),
            ("kinematics_solver_search_resolution", Yaml::number(0.005)),
            ("kinematics_solver_timeout", Yaml::number(0.05)),
        ])
    };
    let chains = config.chains();
    Yaml::named(chains.map(|group| (config.setup.groups[group].value.name.as_str(), solver())))
}

/// The planners of each group that something drives.
fn planners(config: &Config) -> String {
    let groups = config.setup.groups.iter().zip(&config.joints);
    let groups = groups.filter(|(group, joints)| !group.value.passive && !joints.is_empty());
    let groups = groups.map(|(group, _)| {
        let of_group = Yaml::map([
            ("default_planner_config", Yaml::plain(PLANNERS[0])),
            ("planner_configs", Yaml::List(PLANNERS.map(Yaml::plain).into())),
        ]);
        Yaml::named([(group.value.name.as_str(), of_group)]).document(&[])
    });
    groups.collect()
}

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

fn package_files(config: &Config, controllers: &[Controller]) -> Vec<(String, String)> {
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
