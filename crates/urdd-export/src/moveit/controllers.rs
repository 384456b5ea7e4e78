//! Controllers: those that MoveIt sends trajectories to, and those of ros2_control that follow them.

use super::super::error::ExportError;
use super::super::yaml::{Yaml, head, quoted};
use super::config::Config;

pub(super) fn files(config: &Config) -> Result<Vec<(String, String)>, ExportError> {
    let controllers = controllers(config);
    let moveit = config.comments("The controllers that MoveIt sends trajectories to.")?;
    let ros2 = config.comments("The controllers of ros2_control.")?;
    let moveit = head(&moveit) + EXECUTION + &manager(config, &controllers).document(&[]);
    let ros2 = self::ros2(config, &controllers).document(&ros2);
    Ok(vec![
        ("config/moveit_controllers.yaml".to_owned(), moveit),
        ("config/ros2_controllers.yaml".to_owned(), ros2),
    ])
}

/// How MoveIt executes trajectories.
const EXECUTION: &str = include_str!("moveit_controllers.yaml.in");

/// A controller of a group.
struct Controller {
    name: String,
    joints: Vec<usize>,
    /// Whether it is told a single position and the greatest effort, as grippers of one joint are.
    is_gripper: bool,
}

fn controllers(config: &Config) -> Vec<Controller> {
    let ends: Vec<usize> = config.setup.end_effectors.iter().map(|end| end.value.group).collect();
    let each = config.controlled().into_iter().map(|(group, joints)| Controller {
        name: format!("{}_controller", config.setup.groups[group].value.name),
        is_gripper: ends.contains(&group) && joints.len() == 1,
        joints,
    });
    each.collect()
}

/// The names of the controllers that are started.
pub(super) fn names(config: &Config) -> Vec<String> {
    controllers(config).into_iter().map(|controller| controller.name).collect()
}

fn manager(config: &Config, controllers: &[Controller]) -> Yaml {
    let mut manager = vec![(
        "controller_names".to_owned(),
        Yaml::texts(controllers.iter().map(|controller| controller.name.as_str())),
    )];
    for controller in controllers {
        let [action, kind] = if controller.is_gripper {
            ["gripper_cmd", "GripperCommand"]
        } else {
            ["follow_joint_trajectory", "FollowJointTrajectory"]
        };
        let joints = controller.joints.iter().map(|joint| config.joint(*joint));
        let entry = Yaml::map([
            ("action_ns", Yaml::plain(action)),
            ("type", Yaml::plain(kind)),
            ("default", Yaml::plain("true")),
            ("joints", Yaml::texts(joints)),
        ]);
        manager.push((quoted(&controller.name), entry));
    }
    Yaml::map([("moveit_simple_controller_manager", Yaml::Map(manager))])
}

fn ros2(config: &Config, controllers: &[Controller]) -> Yaml {
    let kind = |kind: &str| Yaml::map([("type", Yaml::plain(kind))]);
    let mut manager = vec![("update_rate".to_owned(), Yaml::plain("100"))];
    let mut entries = Vec::new();
    for controller in controllers {
        let name = quoted(&controller.name);
        let joints: Vec<&str> =
            controller.joints.iter().map(|joint| config.joint(*joint)).collect();
        let (plugin, parameters) = match (controller.is_gripper, &joints[..]) {
            (true, [joint]) => (
                "position_controllers/GripperActionController",
                Yaml::map([("joint", Yaml::text(joint))]),
            ),
            _ => (
                "joint_trajectory_controller/JointTrajectoryController",
                Yaml::map([
                    ("command_interfaces", Yaml::List(vec![Yaml::plain("position")])),
                    (
                        "state_interfaces",
                        Yaml::List(vec![Yaml::plain("position"), Yaml::plain("velocity")]),
                    ),
                    ("joints", Yaml::texts(joints)),
                    ("allow_nonzero_velocity_at_trajectory_end", Yaml::plain("true")),
                ]),
            ),
        };
        manager.push((name.clone(), kind(plugin)));
        entries.push((name, Yaml::map([("ros__parameters", parameters)])));
    }
    let broadcaster = kind("joint_state_broadcaster/JointStateBroadcaster");
    manager.push(("joint_state_broadcaster".to_owned(), broadcaster));
    let manager = Yaml::map([("ros__parameters", Yaml::Map(manager))]);
    entries.insert(0, ("controller_manager".to_owned(), manager));
    Yaml::Map(entries)
}
