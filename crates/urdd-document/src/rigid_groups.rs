//! Rigid groups: links connected by fixed joints.

use super::robot::Robot;
use super::tree::Tree;
use urdd_format::urdf::JointType;

/// Links that never move relative to each other.
#[derive(Debug, Clone)]
pub struct RigidGroup {
    /// Its links, parents before their children.
    pub links: Vec<usize>,
    /// The joint that moves it; `None` for the root's group.
    pub moved_by: Option<usize>,
}

/// The rigid groups of a robot, from the root downwards.
#[derive(Debug, Clone)]
pub struct RigidGroups {
    /// The groups.
    pub groups: Vec<RigidGroup>,
    /// Group of each link.
    pub of_link: Vec<usize>,
}

impl RigidGroups {
    /// The groups of a robot.
    pub fn new(robot: &Robot, tree: &Tree) -> Self {
        let mut groups: Vec<RigidGroup> = Vec::new();
        let mut of_link = vec![0; robot.links.len()];
        for &link in &tree.order {
            let joint = tree.parent_joint[link];
            let fixed =
                joint.is_some_and(|joint| robot.joints[joint].joint_type == JointType::Fixed);
            match tree.parent_link[link] {
                Some(parent) if fixed => {
                    of_link[link] = of_link[parent];
                    groups[of_link[parent]].links.push(link);
                }
                _ => {
                    of_link[link] = groups.len();
                    groups.push(RigidGroup { links: vec![link], moved_by: joint });
                }
            }
        }
        RigidGroups { groups, of_link }
    }
}
