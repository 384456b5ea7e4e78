//! A robot with what follows from it, each part computed on first use.

use std::sync::OnceLock;

use super::robot::Robot;
use super::tree::{Mimics, RigidGroups, Tree};

/// A robot, its tree, its rigid groups and its mimics.
pub struct Mechanism {
    robot: Robot,
    tree: OnceLock<Option<Tree>>,
    mimics: OnceLock<Option<Mimics>>,
    rigid_groups: OnceLock<Option<RigidGroups>>,
}

impl Mechanism {
    /// That of a robot.
    pub fn new(robot: Robot) -> Self {
        Mechanism {
            robot,
            tree: OnceLock::new(),
            mimics: OnceLock::new(),
            rigid_groups: OnceLock::new(),
        }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The kinematic tree; `None` if the joints do not form a tree.
    pub fn tree(&self) -> Option<&Tree> {
        self.tree.get_or_init(|| Tree::new(&self.robot)).as_ref()
    }

    /// The rigid groups; `None` if the joints do not form a tree.
    pub fn rigid_groups(&self) -> Option<&RigidGroups> {
        let make = || Some(RigidGroups::new(&self.robot, self.tree()?));
        self.rigid_groups.get_or_init(make).as_ref()
    }

    /// The resolved mimic joints; `None` if they cannot be resolved.
    pub fn mimics(&self) -> Option<&Mimics> {
        self.mimics.get_or_init(|| Mimics::resolve(&self.robot)).as_ref()
    }
}
