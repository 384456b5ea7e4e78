//! What the files of a package have in common.

use std::collections::HashMap;

use crate::groups::joints_of;
use crate::names::FileNames;
use crate::urdf_elements::ros2_control;
use crate::{ExportError, Members, Ros, Setup, Subject};
use urdd_format::named_configurations::NamedConfiguration;
use urdd_format::urdf::{JointType, Limit};
use urdd_xml::Node;
use urdd_xml::element::children;

pub(super) struct Config<'a> {
    pub subject: &'a Subject<'a>,
    pub package: &'a str,
    pub ros: Ros,
    pub setup: &'a Setup,
    pub name: String,
    /// The joints of each group that move, in joint order.
    pub joints: Vec<Vec<usize>>,
    pub configurations: &'a [NamedConfiguration],
    dofs: Vec<Option<usize>>,
    pub default: Vec<f64>,
    pub hardware: Hardware,
}

impl<'a> Config<'a> {
    pub fn new(
        subject: &'a Subject<'a>,
        package: &'a str,
        setup: &'a Setup,
    ) -> Result<Self, ExportError> {
        let groups = 0..setup.groups.len();
        let joints: Vec<_> = groups.map(|group| joints_of(setup, group, subject)).collect();
        Ok(Config {
            hardware: Hardware::new(subject, setup, &joints),
            subject,
            package,
            ros: subject.options.chosen.ros.unwrap_or_default(),
            setup,
            name: FileNames::default().of(&subject.urdf.name),
            joints,
            configurations: subject.robot.named_configurations()?,
            dofs: subject.dofs()?,
            default: subject.robot.configurations()?.zero(),
        })
    }

    pub fn joint(&self, joint: usize) -> &str {
        &self.subject.view.joints[joint].name
    }

    /// The position of a joint of one DOF in a configuration.
    pub fn position(&self, configuration: &[f64], joint: usize) -> f64 {
        self.dofs[joint].map_or(0.0, |dof| configuration[dof])
    }

    /// The groups that are chains, for which inverse kinematics can be solved.
    pub fn chains(&self) -> impl Iterator<Item = usize> {
        let groups = self.setup.groups.iter().enumerate();
        groups
            .filter(|(_, group)| matches!(group.value.members, Members::Chain { .. }))
            .map(|(place, _)| place)
    }

    /// The groups with controllers, each with its joints of one DOF: none that another group has.
    pub fn controlled(&self) -> Vec<(usize, Vec<usize>)> {
        let mut taken = vec![false; self.subject.view.joints.len()];
        let mut controlled = Vec::new();
        for (place, group) in self.setup.groups.iter().enumerate() {
            let joints = self.joints[place].iter().copied();
            let joints: Vec<usize> =
                joints.filter(|joint| self.subject.is_driven(*joint)).collect();
            let is_new = !joints.is_empty() && joints.iter().all(|joint| !taken[*joint]);
            if is_new && !group.value.passive {
                joints.iter().for_each(|joint| taken[*joint] = true);
                controlled.push((place, joints));
            }
        }
        controlled
    }

    /// The limits of a joint: velocity, acceleration and jerk. Those of `[limits]` where the URDF has none.
    pub fn limits(&self, joint: usize) -> [Option<f64>; 3] {
        let source = self.subject.urdf.joints[joint].limit.as_ref();
        let positive = |value: Option<f64>| value.filter(|value| *value > 0.0 && value.is_finite());
        let of = |value: fn(&Limit) -> Option<f64>| positive(source.and_then(value));
        [
            of(|limit| limit.velocity),
            of(|limit| limit.acceleration).or(self.setup.acceleration),
            of(|limit| limit.jerk).or(self.setup.jerk),
        ]
    }

    /// Says that a file was made, and of what.
    pub fn comments(&self, what: &str) -> Result<Vec<String>, ExportError> {
        let mut lines = self.subject.origin()?;
        lines.push(what.to_owned());
        Ok(lines)
    }
}

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

#[derive(Debug, Clone)]
struct Interfaces {
    commands: [bool; 3],
    tells_velocity: bool,
}

pub(super) struct Hardware {
    joints: Vec<Interfaces>,
    /// Whether the source has hardware.
    pub is_of_source: bool,
}

impl Hardware {
    /// That of the source. A joint without any takes positions; a group of continuous joints that is no chain, such as
    /// wheels, takes velocities.
    fn new(subject: &Subject, setup: &Setup, groups: &[Vec<usize>]) -> Self {
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

    pub fn tells_velocity(&self, joint: usize) -> bool {
        self.joints[joint].tells_velocity
    }

    pub fn commands(&self, joint: usize) -> impl Iterator<Item = Command> {
        let has = self.joints[joint].commands;
        Command::ALL.into_iter().zip(has).filter(|(_, has)| *has).map(|(command, _)| command)
    }
}

fn has_interface(joint: Node, kind: &str, command: Command) -> bool {
    let mut interfaces = children(joint).filter(|(name, _)| *name == kind);
    interfaces.any(|(_, interface)| interface.attribute("name") == Some(command.word()))
}
