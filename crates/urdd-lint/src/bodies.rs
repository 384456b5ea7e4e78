//! Bodies: links that fixed joints hold together.

use nalgebra::Isometry3;

use super::inertial::mass;
use urdd_document::robot::Robot;
use urdd_document::tree::Tree;
use urdd_format::urdf::JointType;

#[derive(Debug)]
pub struct Bodies {
    pub tree: Tree,
    /// The topmost link of each link's body.
    pub top: Vec<usize>,
    /// Each link's pose in the frame of its body's topmost link.
    pub pose: Vec<Isometry3<f64>>,
    /// The links of each body, by its topmost link; none for the other links.
    members: Vec<Vec<usize>>,
}

impl Bodies {
    /// Those of a robot; `None` if it is no tree (URD004 to URD007 say so).
    pub fn new(robot: &Robot) -> Option<Self> {
        let tree = Tree::new(robot)?;
        let links = robot.links.len();
        let (mut top, mut pose) =
            ((0..links).collect::<Vec<_>>(), vec![Isometry3::identity(); links]);
        for &link in &tree.order {
            let (Some(joint), Some(parent)) = (tree.parent_joint[link], tree.parent_link[link])
            else {
                continue;
            };
            let joint = &robot.joints[joint];
            if joint.joint_type == JointType::Fixed {
                top[link] = top[parent];
                pose[link] = pose[parent] * joint.origin.motion();
            }
        }
        let mut members = vec![Vec::new(); links];
        for (link, &top) in top.iter().enumerate() {
            members[top].push(link);
        }
        Some(Bodies { tree, top, pose, members })
    }

    /// The links of a body, by its topmost link.
    pub fn members(&self, top: usize) -> impl Iterator<Item = usize> {
        self.members[top].iter().copied()
    }

    /// The topmost links, in link order.
    pub fn tops(&self) -> impl Iterator<Item = usize> {
        let all = self.top.iter().enumerate();
        all.filter(|(link, top)| link == *top).map(|(link, _)| link)
    }
}

/// The links that can only slide: prismatic and fixed joints lead to them from a base that is fixed to the world, so that
/// their inertia has no effect. A base is fixed if it is called `world`, or has no mass to move by.
pub fn slide_only(robot: &Robot, bodies: &Bodies) -> Vec<bool> {
    let root = bodies.tree.root;
    let has_mass = |link: usize| mass(&robot.links[link]) > Some(0.0);
    let is_fixed = robot.links[root].name == "world" || !bodies.members(root).any(has_mass);
    let mut slides = vec![false; robot.links.len()];
    for &link in &bodies.tree.order {
        slides[link] = match (bodies.tree.parent_joint[link], bodies.tree.parent_link[link]) {
            (Some(joint), Some(parent)) => {
                let kind = robot.joints[joint].joint_type;
                slides[parent] && matches!(kind, JointType::Fixed | JointType::Prismatic)
            }
            _ => is_fixed,
        };
    }
    slides
}
