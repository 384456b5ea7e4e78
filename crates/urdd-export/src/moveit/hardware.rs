//! What joints are told: by the command interfaces of the source's `<ros2_control>`.

use std::collections::HashMap;

use crate::urdf_elements::ros2_control;
use crate::{Members, Setup, Subject};
use urdd_format::urdf::JointType;
use urdd_xml::Node;
use urdd_xml::element::children;

/// What a joint is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Command {
    Position,
    Velocity,
    Effort,
}

impl Command {
    /// All, the one that MoveIt's trajectories need first.
    pub const ALL: [Command; 3] = [Command::Position, Command::Velocity, Command::Effort];

    /// Its name in ros2_control.
    pub fn word(self) -> &'static str {
        match self {
            Command::Position => "position",
            Command::Velocity => "velocity",
            Command::Effort => "effort",
        }
    }
}

/// The interfaces of a joint.
#[derive(Debug, Clone)]
struct Interfaces {
    commands: [bool; 3],
    tells_velocity: bool,
}

/// The interfaces of joints.
pub(super) struct Hardware {
    /// By joint.
    joints: Vec<Interfaces>,
    /// Whether the source has hardware.
    pub is_of_source: bool,
}

impl Hardware {
    /// That of the source. A joint without any takes positions; a group of continuous joints that is no chain, such as
    /// wheels, takes velocities.
    pub fn new(subject: &Subject, setup: &Setup, groups: &[Vec<usize>]) -> Self {
        let all = &subject.view.joints;
        let mut joints =
            vec![Interfaces { commands: [true, false, false], tells_velocity: true }; all.len()];
        for (group, members) in setup.groups.iter().zip(groups) {
            let turns = |joint: &usize| all[*joint].joint_type == JointType::Continuous;
            if matches!(group.value.members, Members::Joints(_)) && members.iter().all(turns) {
                members.iter().for_each(|joint| joints[*joint].commands = [false, true, false]);
            }
        }
        let names = all.iter().zip(0..).map(|(joint, index)| (joint.name.as_str(), index));
        let by_name: HashMap<&str, usize> = names.collect();
        let mut of_source: HashMap<usize, Interfaces> = HashMap::new();
        let mut is_of_source = false;
        for text in &subject.urdf.unknown_elements {
            let Some(document) = ros2_control(text) else { continue };
            is_of_source = true;
            let in_it = children(document.root_element());
            for (_, joint) in in_it.filter(|(name, _)| *name == "joint") {
                let index = joint.attribute("name").and_then(|name| by_name.get(name));
                let Some(index) = index else { continue };
                let known = of_source
                    .entry(*index)
                    .or_insert(Interfaces { commands: [false; 3], tells_velocity: false });
                for (has, command) in known.commands.iter_mut().zip(Command::ALL) {
                    *has |= has_interface(joint, "command_interface", command);
                }
                known.tells_velocity |= has_interface(joint, "state_interface", Command::Velocity);
            }
        }
        of_source.into_iter().for_each(|(index, found)| joints[index] = found);
        Hardware { joints, is_of_source }
    }

    /// What a joint is told: a position where it takes one. `None` if it takes nothing.
    pub fn told(&self, joint: usize) -> Option<Command> {
        self.commands(joint).next()
    }

    /// Whether a joint tells its velocity.
    pub fn tells_velocity(&self, joint: usize) -> bool {
        self.joints[joint].tells_velocity
    }

    /// All that a joint takes.
    pub fn commands(&self, joint: usize) -> impl Iterator<Item = Command> {
        let has = self.joints[joint].commands;
        Command::ALL.into_iter().zip(has).filter(|(_, has)| *has).map(|(command, _)| command)
    }
}

fn has_interface(joint: Node, kind: &str, command: Command) -> bool {
    let mut interfaces = children(joint).filter(|(name, _)| *name == kind);
    interfaces.any(|(_, interface)| interface.attribute("name") == Some(command.word()))
}
