//! Controllers: those that MoveIt sends trajectories to, and those of ros2_control that follow them.

use super::config::{Command, Config};
use crate::yaml::{head, quoted};
use crate::{ExportError, Limited, Note, Ros, Taken, Yaml};

const EXECUTION: &str = include_str!("moveit_controllers.yaml.in");

/// The controller that says where joints are.
const BROADCASTER: &str = "joint_state_broadcaster";

const NO_TRAJECTORIES: &str = "MoveIt sends it no trajectories, since not all of its joints take positions; config/ros2_controllers.yaml has what drives those that take velocity or effort";

pub(super) struct Controller {
    name: String,
    joints: Vec<usize>,
    kind: ControllerKind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum ControllerKind {
    /// It follows trajectories of positions.
    Trajectory,
    /// It is told a single position and the greatest effort, as grippers of one joint are.
    Gripper,
    /// It passes on velocities, which MoveIt does not send.
    Velocities,
    /// It passes on efforts, which MoveIt does not send.
    Efforts,
}

pub(super) fn controllers(config: &Config) -> Vec<Controller> {
    let ends: Vec<usize> = config.setup.end_effectors.iter().map(|end| end.value.group).collect();
    let mut taken = Taken::default();
    taken.insert(BROADCASTER);
    let mut controllers = Vec::new();
    for (group, joints) in config.controlled() {
        for command in Command::ALL {
            let is_told = |joint: &usize| config.hardware.told(*joint) == Some(command);
            let told: Vec<usize> = joints.iter().copied().filter(is_told).collect();
            if told.is_empty() {
                continue;
            }
            let suffix = || format!("_{}", command.word());
            let (kind, what) = match command {
                Command::Position if ends.contains(&group) && joints.len() == 1 => {
                    (ControllerKind::Gripper, String::new())
                }
                Command::Position => (ControllerKind::Trajectory, String::new()),
                Command::Velocity => (ControllerKind::Velocities, suffix()),
                Command::Effort => (ControllerKind::Efforts, suffix()),
            };
            let name = &config.setup.groups[group].value.name;
            let name = taken.free(format!("{name}{what}_controller"));
            controllers.push(Controller { name, joints: told, kind });
        }
    }
    controllers
}

impl Controller {
    /// What MoveIt sends it; nothing to one that follows no trajectories.
    fn action(&self, ros: Ros) -> Option<[&'static str; 2]> {
        match (self.kind, ros) {
            (ControllerKind::Trajectory, _) => {
                Some(["follow_joint_trajectory", "FollowJointTrajectory"])
            }
            (ControllerKind::Gripper, Ros::Humble) => Some(["gripper_cmd", "GripperCommand"]),
            (ControllerKind::Gripper, Ros::Jazzy) => {
                Some(["gripper_cmd", "ParallelGripperCommand"])
            }
            (ControllerKind::Velocities | ControllerKind::Efforts, _) => None,
        }
    }

    /// Its package and its plugin.
    fn plugin(&self, ros: Ros) -> [&'static str; 2] {
        match (self.kind, ros) {
            (ControllerKind::Gripper, Ros::Humble) => {
                ["gripper_controllers", "position_controllers/GripperActionController"]
            }
            (ControllerKind::Gripper, Ros::Jazzy) => [
                "parallel_gripper_controller",
                "parallel_gripper_action_controller/GripperActionController",
            ],
            (ControllerKind::Velocities, _) => {
                ["velocity_controllers", "velocity_controllers/JointGroupVelocityController"]
            }
            (ControllerKind::Efforts, _) => {
                ["effort_controllers", "effort_controllers/JointGroupEffortController"]
            }
            (ControllerKind::Trajectory, _) => [
                "joint_trajectory_controller",
                "joint_trajectory_controller/JointTrajectoryController",
            ],
        }
    }

    fn parameters(&self, config: &Config) -> Yaml {
        let joints = || self.joints.iter().map(|joint| config.joint(*joint));
        match self.kind {
            ControllerKind::Gripper => {
                Yaml::Map(joints().map(|joint| ("joint".to_owned(), Yaml::text(joint))).collect())
            }
            ControllerKind::Velocities | ControllerKind::Efforts => {
                Yaml::map([("joints", Yaml::texts(joints()))])
            }
            ControllerKind::Trajectory => {
                let mut states = vec![Yaml::plain("position")];
                if self.joints.iter().all(|joint| config.hardware.tells_velocity(*joint)) {
                    states.push(Yaml::plain("velocity"));
                }
                Yaml::map([
                    ("command_interfaces", Yaml::List(vec![Yaml::plain("position")])),
                    ("state_interfaces", Yaml::List(states)),
                    ("joints", Yaml::texts(joints())),
                    ("allow_nonzero_velocity_at_trajectory_end", Yaml::plain("true")),
                ])
            }
        }
    }
}

pub(super) fn files(
    config: &Config,
    controllers: &[Controller],
) -> Result<Vec<(String, String)>, ExportError> {
    let moveit = config.comments("The controllers that MoveIt sends trajectories to.")?;
    let ros2 = config.comments("The controllers of ros2_control.")?;
    let moveit = head(&moveit) + EXECUTION + &manager(config, controllers);
    let ros2 = self::ros2(config, controllers).document(&ros2);
    Ok(vec![
        ("config/moveit_controllers.yaml".to_owned(), moveit),
        ("config/ros2_controllers.yaml".to_owned(), ros2),
    ])
}

pub(super) fn names(controllers: &[Controller]) -> impl Iterator<Item = &str> {
    controllers.iter().map(|controller| controller.name.as_str())
}

pub(super) fn packages(controllers: &[Controller], ros: Ros) -> impl Iterator<Item = &'static str> {
    controllers.iter().map(move |controller| controller.plugin(ros)[0])
}

/// What a person has to know of controllers and limits.
pub(super) fn notes(config: &Config, controllers: &[Controller]) -> Vec<Note> {
    let ros = config.ros;
    let groups = config.controlled().into_iter().filter(|(_, joints)| {
        joints.iter().any(|joint| config.hardware.told(*joint) != Some(Command::Position))
    });
    let groups = groups.map(|(group, _)| Note::Group {
        group: config.setup.groups[group].value.name.clone(),
        what: NO_TRAJECTORIES,
    });
    let moved = controllers.iter().filter(|controller| controller.action(ros).is_some());
    let moved: Vec<usize> = moved.flat_map(|controller| controller.joints.clone()).collect();
    let unlimited = Limited::ALL.into_iter().filter_map(|what| {
        let is_without = |joint: &&usize| config.limits(**joint)[what as usize].is_none();
        let joints = moved.iter().filter(is_without);
        let joints: Vec<String> = joints.map(|joint| config.joint(*joint).to_owned()).collect();
        (!joints.is_empty()).then_some(Note::Unlimited { what, joints, ros })
    });
    groups.chain(unlimited).collect()
}

fn manager(config: &Config, controllers: &[Controller]) -> String {
    let mut names = Vec::new();
    let mut entries = Vec::new();
    for controller in controllers {
        let Some([action, kind]) = controller.action(config.ros) else { continue };
        let joints = controller.joints.iter().map(|joint| config.joint(*joint));
        let entry = Yaml::map([
            ("action_ns", Yaml::plain(action)),
            ("type", Yaml::plain(kind)),
            ("default", Yaml::plain("true")),
            ("joints", Yaml::texts(joints)),
        ]);
        names.push(controller.name.as_str());
        entries.push((quoted(&controller.name), entry));
    }
    // ROS cannot tell of what type an empty list is.
    if names.is_empty() {
        return String::new();
    }
    entries.insert(0, ("controller_names".to_owned(), Yaml::texts(names)));
    Yaml::map([("moveit_simple_controller_manager", Yaml::Map(entries))]).document(&[])
}

fn ros2(config: &Config, controllers: &[Controller]) -> Yaml {
    let kind = |kind: &str| Yaml::map([("type", Yaml::plain(kind))]);
    let mut manager = vec![("update_rate".to_owned(), Yaml::plain("100"))];
    let mut entries = Vec::new();
    for controller in controllers {
        let name = quoted(&controller.name);
        let [_, plugin] = controller.plugin(config.ros);
        manager.push((name.clone(), kind(plugin)));
        entries.push((name, Yaml::map([("ros__parameters", controller.parameters(config))])));
    }
    let broadcaster = kind("joint_state_broadcaster/JointStateBroadcaster");
    manager.push((BROADCASTER.to_owned(), broadcaster));
    let manager = Yaml::map([("ros__parameters", Yaml::Map(manager))]);
    entries.insert(0, ("controller_manager".to_owned(), manager));
    Yaml::Map(entries)
}
