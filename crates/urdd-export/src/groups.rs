//! Joint groups, as the DOFs of a robot.

use crate::setup::within;
use crate::{ExportError, Members, Setup, Structure};
use urdd_robot::Robot;

/// A group of joints that a planner moves together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JointGroup {
    /// Its name.
    pub name: String,
    /// The DOFs of its joints, ascending: none of joints that are fixed or follow others.
    pub dofs: Vec<usize>,
}

impl Setup {
    /// The groups, in the order of the file.
    ///
    /// # Errors
    /// If the description of the robot is missing or unusable, or the setup is that of another robot.
    pub fn joint_groups(&self, robot: &Robot) -> Result<Vec<JointGroup>, ExportError> {
        let structure = Structure::new(robot)?;
        structure.check(&self.of)?;
        let groups = self.groups.iter().enumerate().map(|(place, group)| {
            let joints = joints_of(self, place, &structure);
            JointGroup::of(&group.value.name, joints, robot, &structure)
        });
        groups.collect()
    }
}

impl JointGroup {
    pub(super) fn of(
        name: &str,
        joints: impl IntoIterator<Item = usize>,
        robot: &Robot,
        structure: &Structure,
    ) -> Result<Self, ExportError> {
        let mut dofs = Vec::new();
        for joint in joints {
            if structure.moves(joint) {
                let (parent, child) = structure.tree.joint_links[joint];
                dofs.extend(robot.dofs_between(parent, child)?);
            }
        }
        dofs.sort_unstable();
        let name = name.to_owned();
        Ok(JointGroup { name, dofs })
    }
}

/// The joints of a group that move it, in joint order: none that are fixed or follow others.
pub(super) fn joints_of(setup: &Setup, group: usize, structure: &Structure) -> Vec<usize> {
    let members = |group: usize| &setup.groups[group].value.members;
    let inner = |group: usize| match members(group) {
        Members::Groups(others) => others.as_slice(),
        _ => &[],
    };
    let mut joints = Vec::new();
    for group in within(group, setup.groups.len(), inner).unwrap_or_default() {
        match members(group) {
            Members::Chain { base, tip } => joints.extend(structure.between(*base, *tip)),
            Members::Joints(own) => joints.extend(own),
            Members::Groups(_) => {}
        }
    }
    joints.retain(|joint| structure.moves(*joint));
    joints.sort_unstable();
    joints.dedup();
    joints
}
